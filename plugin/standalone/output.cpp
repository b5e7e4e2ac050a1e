#include "output.h"

#include "error.h"

#include <tinyxml2.h>

#include <filesystem>
#include <functional>
#include <sstream>

namespace standalone {
namespace {

using tinyxml2::XMLElement;

/// Values of Model::node_data() at the nodes, shape (names, nodes).
MatrixXd node_table(const Problem& problem) {
  const Model& model = problem.model();
  const MatrixXd& fields = problem.values();
  MatrixXd table(9 + fields.rows() - 3, fields.cols());
  table << model.mesh.nodes + fields.topRows(3), fields, problem.reactions();
  return table;
}

/// Values of Model::element_data(), averaged over each element, shape (names, elements).
MatrixXd element_table(const Problem& problem) {
  const Model& model = problem.model();
  const Bodies& bodies = problem.bodies();
  MatrixXd table = MatrixXd::Zero(static_cast<Index>(model.element_data().size()),
                                  static_cast<Index>(bodies.elements()));
  for (std::size_t e = 0; e < bodies.elements(); ++e) {
    const Bodies::Average mean = bodies.average(e, problem.values());
    auto column = table.col(static_cast<Index>(e));
    column.head<4>() << mean.pressure, mean.solvent_flux;
    const std::optional<Solute>& solute = bodies.material(e).solute;
    if (solute) column.segment<4>(4 + 4 * solute->index) << mean.concentration, mean.solute_flux;
    if (!model.solutes.empty()) column.tail<4>() = column.segment<4>(4);
  }
  return table;
}

// ------------------------------------------------------------ VTK's XML formats

constexpr int vtk_hexahedron = 12;
constexpr int vtk_quadratic_hexahedron = 25;

/// Writes a VTK file. `fill` fills the tag below the root, which has the name of the type.
void write_vtk_file(const std::filesystem::path& path, const char* type, const std::function<void(XMLElement&)>& fill) {
  tinyxml2::XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  XMLElement& root = *document.NewElement("VTKFile");
  document.InsertEndChild(&root);
  root.SetAttribute("type", type);
  root.SetAttribute("version", "0.1");
  fill(*root.InsertNewChildElement(type));
  if (document.SaveFile(path.string().c_str()) != tinyxml2::XML_SUCCESS)
    throw InputError("the file " + path.string() + " cannot be written");
}

template <class Values>
void add_array(XMLElement& parent, const std::string& name, const char* type, const Values& values, Index components) {
  std::ostringstream text;
  text.precision(12);
  for (const auto value : values) text << value << ' ';
  XMLElement& array = *parent.InsertNewChildElement("DataArray");
  array.SetAttribute("Name", name.c_str());
  array.SetAttribute("type", type);
  array.SetAttribute("NumberOfComponents", static_cast<int>(components));
  array.SetAttribute("format", "ascii");
  array.SetText(text.str().c_str());
}

void add_matrix(XMLElement& parent, const std::string& name, const MatrixXd& columns) {
  add_array(parent, name, "Float64", columns.reshaped(), columns.rows());
}

void add_cells(XMLElement& parent, const Mesh& mesh) {
  std::vector<int> nodes;
  std::vector<int> ends;
  std::vector<int> types;
  for (const Element& element : mesh.elements) {
    nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.end());
    ends.push_back(number_of(nodes));
    types.push_back(element.nodes.size() == 8 ? vtk_hexahedron : vtk_quadratic_hexahedron);
  }
  add_array(parent, "connectivity", "Int32", nodes, 1);
  add_array(parent, "offsets", "Int32", ends, 1);
  add_array(parent, "types", "UInt8", types, 1);
}

/// Adds the mesh with u, p~ and each c~ at the nodes.
void add_grid(XMLElement& grid, const Model& model, const MatrixXd& values) {
  XMLElement& piece = *grid.InsertNewChildElement("Piece");
  piece.SetAttribute("NumberOfPoints", static_cast<int>(model.mesh.nodes.cols()));
  piece.SetAttribute("NumberOfCells", number_of(model.mesh.elements));
  add_matrix(*piece.InsertNewChildElement("Points"), "position", model.mesh.nodes);
  add_cells(*piece.InsertNewChildElement("Cells"), model.mesh);
  XMLElement& data = *piece.InsertNewChildElement("PointData");
  add_matrix(data, "displacement", values.topRows(3));
  add_matrix(data, "effective fluid pressure", values.row(pressure_dof));
  for (int k = 0; k < number_of(model.solutes); ++k)
    add_matrix(data, "effective concentration " + std::to_string(k + 1), values.row(concentration_dof(k)));
}

}  // namespace

Output::Output(const Model& model) {
  for (const DataFile& data : model.data) {
    const auto path = std::filesystem::path(model.file).parent_path() / data.file;
    streams_.emplace_back(path);
    if (!streams_.back()) throw InputError("the data file " + path.string() + " cannot be written");
  }
}

void Output::write(const Problem& problem, int step, double time) {
  for (std::size_t file = 0; file < streams_.size(); ++file) write_data(problem, file, step, time);
  if (problem.model().control.plot) write_vtk(problem, step, time);
}

void Output::write_data(const Problem& problem, std::size_t file, int step, double time) {
  const DataFile& data = problem.model().data[file];
  std::ofstream& stream = streams_[file];
  stream.precision(9);
  stream << "*Step  = " << step << "\n*Time  = " << time << "\n*Data  = " << data.names << '\n';
  stream.precision(12);
  const MatrixXd table = data.elements ? element_table(problem) : node_table(problem);
  for (Index item = 0; item < table.cols(); ++item) {
    stream << item + 1;
    for (const int row : data.rows) stream << data.separator << table(row, item);
    stream << '\n';
  }
  stream.flush();
}

void Output::write_vtk(const Problem& problem, int step, double time) {
  const std::filesystem::path stem = std::filesystem::path(problem.model().file).replace_extension();
  const std::filesystem::path folder = stem.string() + "-vtk";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string file = "state" + std::to_string(step) + ".vtu";
  write_vtk_file(folder / file, "UnstructuredGrid",
                 [&](XMLElement& grid) { add_grid(grid, problem.model(), problem.values()); });
  states_.emplace_back(time, (folder.filename() / file).string());
  write_vtk_file(stem.string() + ".pvd", "Collection", [&](XMLElement& collection) {
    for (const auto& [at, name] : states_) {
      XMLElement& state = *collection.InsertNewChildElement("DataSet");
      state.SetAttribute("timestep", at);
      state.SetAttribute("file", name.c_str());
    }
  });
}

}  // namespace standalone
