#include "columns.h"
#include "sections.h"

#include <sstream>

namespace standalone {
namespace {

template <class Column>
void check_columns(const Tag& tag, const DataFile& file, const std::map<std::string, Column>& known) {
  for (const std::string& name : file.columns) {
    if (known.count(name) == 0) tag.fail("the data \"" + name + "\" are not supported; there is " + names_of(known));
  }
}

}  // namespace

void read_output(const Tag& section, Model& model) {
  section.allow_children({"logfile", "plotfile"});
  if (const auto plot = section.find("plotfile"); plot && model.control.plot) {
    plot->allow_attributes({"type"});
    model.notices.emplace_back(
        "the plot file is written for ParaView (.pvd), with displacement, pressure and concentrations.");
  } else {
    model.control.plot = false;
  }
  const auto log = section.find("logfile");
  if (!log) return;
  log->allow_children({"node_data", "element_data"});
  for (const Tag& tag : log->children()) {
    tag.allow_attributes({"data", "file", "delim", "name"});
    if (!tag.text().empty()) tag.fail("a choice of items is not supported; the data of all are written");
    DataFile file;
    file.elements = tag.name() == "element_data";
    file.names = tag.attribute("data");
    file.file = tag.attribute("file");
    file.separator = tag.find_attribute("delim").value_or(" ");
    std::istringstream names(file.names);
    for (std::string name; std::getline(names, name, ';');) file.columns.push_back(name);
    if (file.columns.empty()) tag.fail("the attribute data names no column");
    if (file.elements) {
      check_columns(tag, file, element_columns(model.solutes));
    } else {
      check_columns(tag, file, node_columns(model.solutes));
    }
    model.data.push_back(std::move(file));
  }
}

}  // namespace standalone
