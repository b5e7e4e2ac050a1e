#include "output.h"

#include "vtk.h"

#include <filesystem>
#include <iomanip>

namespace standalone {
namespace {

double element_value(const ElementColumn& column, const Bodies::Average& average, const Material& material) {
  Index local = 0;
  while (local < average.concentration.size() &&
         material.solutes[static_cast<std::size_t>(local)].index != column.solute)
    ++local;
  const bool has_solute = local < average.concentration.size();
  switch (column.kind) {
    case ElementColumn::Kind::pressure:
      return average.pressure;
    case ElementColumn::Kind::solvent_flux:
      return average.solvent_flux[column.axis];
    case ElementColumn::Kind::concentration:
      return has_solute ? average.concentration[local] : 0.0;
    case ElementColumn::Kind::solute_flux:
      return has_solute ? average.solute_flux(column.axis, local) : 0.0;
    default:
      return average.stress(column.axis, column.axis);
  }
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

double Output::node_value(const NodeColumn& column, int node) const {
  switch (column.kind) {
    case NodeColumn::Kind::position:
      return problem_.model().mesh.nodes(column.dof, node) + problem_.values()(column.dof, node);
    case NodeColumn::Kind::value:
      return problem_.values()(column.dof, node);
    default:
      return problem_.reaction(column.dof, node);
  }
}

void Output::write(int step, double time) {
  for (std::size_t table = 0; table < streams_.size(); ++table) write_data(table, step, time);
  if (problem_.model().control.plot) write_vtk(step, time);
}

void Output::write_row(std::size_t table, int item, const std::vector<double>& values) {
  std::ofstream& stream = streams_[table];
  stream << item;
  for (const double value : values) stream << problem_.model().data[table].separator << value;
  stream << '\n';
}

void Output::write_data(std::size_t table, int step, double time) {
  const DataFile& data = problem_.model().data[table];
  const int solutes = problem_.model().solutes;
  log_.print("\nData Record #%zu\n%s\nStep = %d\nTime = %.9g\nData = %s\nFile = %s\n", table + 1,
             std::string(75, '=').c_str(), step, time, data.names.c_str(), data.file.c_str());
  streams_[table] << "*Step  = " << step << "\n*Time  = " << std::setprecision(9) << time << "\n*Data  = " << data.names
                  << '\n'
                  << std::setprecision(12);
  std::vector<double> row(data.columns.size());
  if (data.elements) {
    for (std::size_t e = 0; e < problem_.bodies().elements(); ++e) {
      const Bodies::Average average = problem_.bodies().average(e, problem_.values());
      for (std::size_t k = 0; k < row.size(); ++k) {
        // NOLINTNEXTLINE(bugprone-unchecked-optional-access): the columns were checked when they were read
        const ElementColumn column = element_column(data.columns[k], solutes).value();
        row[k] = element_value(column, average, problem_.bodies().material(e));
      }
      write_row(table, static_cast<int>(e) + 1, row);
    }
  } else {
    std::vector<NodeColumn> columns;
    columns.reserve(row.size());
    for (const std::string& name : data.columns) {
      if (const auto column = node_column(name, solutes)) columns.push_back(*column);
    }
    for (int node = 0; node < problem_.values().cols(); ++node) {
      for (std::size_t k = 0; k < row.size(); ++k) row[k] = node_value(columns[k], node);
      write_row(table, node + 1, row);
    }
  }
  streams_[table].flush();
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
