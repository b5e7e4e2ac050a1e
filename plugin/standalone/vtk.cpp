#include "vtk.h"

#include "error.h"

#include <tinyxml2.h>

#include <functional>
#include <memory>
#include <sstream>

namespace standalone {
namespace {

using tinyxml2::XMLPrinter;

constexpr int vtk_hexahedron = 12;
constexpr int vtk_quadratic_hexahedron = 25;

/// Opens a file, writes the root tag of a VTK file of a type and what `content` writes.
void write_file(const std::string& path, const char* type, const std::function<void(XMLPrinter&)>& content) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  if (!file) throw InputError("the file " + path + " cannot be written");
  XMLPrinter xml(file.get());
  xml.PushHeader(false, true);
  xml.OpenElement("VTKFile");
  xml.PushAttribute("type", type);
  xml.PushAttribute("version", "0.1");
  content(xml);
  xml.CloseElement();
}

template <class Values>
void array(XMLPrinter& xml, const char* name, const char* type, const Values& values, int components = 1) {
  std::ostringstream text;
  text.precision(12);
  for (const auto value : values) text << value << ' ';
  xml.OpenElement("DataArray");
  xml.PushAttribute("Name", name);
  xml.PushAttribute("type", type);
  xml.PushAttribute("NumberOfComponents", components);
  xml.PushAttribute("format", "ascii");
  xml.PushText(text.str().c_str());
  xml.CloseElement();
}

void matrix(XMLPrinter& xml, const char* name, const MatrixXd& columns) {
  array(xml, name, "Float64", columns.reshaped(), static_cast<int>(columns.rows()));
}

void cells(XMLPrinter& xml, const Mesh& mesh) {
  std::vector<int> nodes;
  std::vector<int> ends;
  std::vector<int> types;
  for (const Element& element : mesh.elements) {
    nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.end());
    ends.push_back(static_cast<int>(nodes.size()));
    types.push_back(element.nodes.size() == 8 ? vtk_hexahedron : vtk_quadratic_hexahedron);
  }
  xml.OpenElement("Cells");
  array(xml, "connectivity", "Int32", nodes);
  array(xml, "offsets", "Int32", ends);
  array(xml, "types", "UInt8", types);
  xml.CloseElement();
}

}  // namespace

void write_vtu(const std::string& path, const Model& model, const MatrixXd& values) {
  write_file(path, "UnstructuredGrid", [&](XMLPrinter& xml) {
    xml.OpenElement("UnstructuredGrid");
    xml.OpenElement("Piece");
    xml.PushAttribute("NumberOfPoints", static_cast<int>(model.mesh.nodes.cols()));
    xml.PushAttribute("NumberOfCells", static_cast<int>(model.mesh.elements.size()));
    xml.OpenElement("Points");
    matrix(xml, "position", model.mesh.nodes);
    xml.CloseElement();
    cells(xml, model.mesh);
    xml.OpenElement("PointData");
    matrix(xml, "displacement", values.topRows(3));
    matrix(xml, "effective fluid pressure", values.row(pressure_dof));
    for (int k = 0; k < model.solutes; ++k) {
      matrix(xml, ("effective concentration " + std::to_string(k + 1)).c_str(), values.row(concentration_dof(k)));
    }
    xml.CloseElement();
    xml.CloseElement();
    xml.CloseElement();
  });
}

void write_pvd(const std::string& path, const std::vector<std::pair<double, std::string>>& states) {
  write_file(path, "Collection", [&](XMLPrinter& xml) {
    xml.OpenElement("Collection");
    for (const auto& [time, file] : states) {
      xml.OpenElement("DataSet");
      xml.PushAttribute("timestep", time);
      xml.PushAttribute("file", file.c_str());
      xml.CloseElement();
    }
    xml.CloseElement();
  });
}

}  // namespace standalone
