#include "output.h"

#include "columns.h"
#include "error.h"
#include "vtk.h"

#include <filesystem>
#include <iomanip>

namespace standalone {
namespace {

/// Writes a line for each item: its number from 1, and its values of the columns.
template <class Column, class... Item>
void write_row(std::ofstream& stream, const DataFile& data, const std::map<std::string, Column>& columns, int number,
               const Item&... item) {
  stream << number;
  for (const std::string& name : data.columns) stream << data.separator << columns.at(name)(item...);
  stream << '\n';
}

}  // namespace

Output::Output(const Problem& problem, Log& log) : problem_(problem), log_(log) {
  const std::filesystem::path folder = std::filesystem::path(problem.model().file).parent_path();
  for (const DataFile& data : problem.model().data) {
    const std::string path = (folder / data.file).string();
    streams_.emplace_back(path);
    if (!streams_.back()) throw InputError("the data file " + path + " cannot be written");
    streams_.back() << std::setprecision(12);
  }
}

void Output::write(int step, double time) {
  for (std::size_t table = 0; table < streams_.size(); ++table) write_data(table, step, time);
  if (problem_.model().control.plot) write_vtk(step, time);
}

void Output::write_data(std::size_t table, int step, double time) {
  const DataFile& data = problem_.model().data[table];
  const int solutes = problem_.model().solutes;
  log_.print("\nData Record #%zu\n%s\nStep = %d\nTime = %.9g\nData = %s\nFile = %s\n", table + 1,
             std::string(75, '=').c_str(), step, time, data.names.c_str(), data.file.c_str());
  std::ofstream& stream = streams_[table];
  stream << "*Step  = " << step << "\n*Time  = " << std::setprecision(9) << time << "\n*Data  = " << data.names << '\n'
         << std::setprecision(12);
  if (data.elements) {
    const auto columns = element_columns(solutes);
    const Bodies& bodies = problem_.bodies();
    for (std::size_t e = 0; e < bodies.elements(); ++e) {
      write_row(stream, data, columns, static_cast<int>(e) + 1, bodies.average(e, problem_.values()),
                bodies.material(e));
    }
  } else {
    const auto columns = node_columns(solutes);
    for (int node = 0; node < problem_.values().cols(); ++node)
      write_row(stream, data, columns, node + 1, problem_, node);
  }
  stream.flush();
}

void Output::write_vtk(int step, double time) {
  const std::filesystem::path model = problem_.model().file;
  const std::filesystem::path stem = model.parent_path() / model.stem();
  const std::filesystem::path folder = stem.string() + "-vtk";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string file = "state" + std::to_string(step) + ".vtu";
  write_vtu((folder / file).string(), problem_.model(), problem_.values());
  states_.emplace_back(time, (folder.filename() / file).string());
  write_pvd(stem.string() + ".pvd", states_);
}

}  // namespace standalone
