/// A model as its file describes it: plain data, checked by the reader.
#pragma once

#include "contact/interface/interface.h"
#include "host/contact_parameters.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace standalone {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using indexing::entries;
using mixture_contact::at;
using mixture_contact::count_of;
using mixture_contact::number_of;

/// Rows of nodal values: displacements u [mm], effective fluid pressure p~ [MPa], effective concentrations c~ [mM].
inline constexpr int pressure_dof = 3;
constexpr int concentration_dof(int solute) { return 4 + solute; }

/// Fields of a material: u1 u2 u3, p~ if it is porous, c~ if it has a solute.
inline constexpr int solute_field = 4;
inline constexpr int max_fields = 5;

/// A function of time: points joined by lines, or steps up to the next point; constant beyond both ends.
struct LoadCurve {
  std::vector<std::array<double, 2>> points;  ///< (time [s], value), times ascending
  bool steps = false;

  double at(double time) const;
};

/// A value, times a load curve where it has one.
struct Parameter {
  double value = 0;
  int curve = -1;  ///< index of the load curve, -1 for none

  double at(double time, const std::vector<LoadCurve>& curves) const;
};

/// A solute in one material.
struct Solute {
  int index = 0;                ///< in the model's list, from 0
  double diffusivity = 0;       ///< d in the mixture [mm^2/s]
  double free_diffusivity = 0;  ///< d0 in the solvent [mm^2/s]
  double solubility = 1;        ///< effective solubility kappa~: c = kappa~ c~ [-]
};

/// A neo-Hookean solid, alone or as the matrix of a mixture, or a rigid body.
struct Material {
  std::string name;
  bool rigid = false;
  bool porous = false;
  double modulus = 0;         ///< Young's modulus at small strain [MPa]
  double poisson = 0;         ///< Poisson's ratio [-]
  double solid_fraction = 0;  ///< phi_s in the reference configuration [-]
  double permeability = 0;    ///< k [mm^4/(N s)]
  double osmotic = 1;         ///< osmotic coefficient Phi [-]
  std::optional<Solute> solute;

  /// Number of its fields.
  int fields() const { return solute ? max_fields : (porous ? 4 : 3); }
  /// Row of nodal values that holds a field.
  int dof(int field) const { return field < solute_field || !solute ? field : concentration_dof(solute->index); }
};

/// A hexahedron in FEBio's node order; 8 nodes, or 20 with those on the edges.
struct Element {
  int id = 0;
  int material = 0;
  std::vector<int> nodes;
  int line = 0;  ///< in the model file
};

/// A facet of a surface (node indices of the mesh), the element behind it, and which of its faces it is.
struct SurfaceFacet {
  mixture_contact::Facet facet;
  int element = -1;
  int face = 0;
};

struct Mesh {
  Matrix3Xd nodes;  ///< reference positions [mm]
  std::vector<Element> elements;
  std::map<std::string, std::vector<int>> parts;  ///< elements of each <Elements> section
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<SurfaceFacet>> surfaces;
  std::map<std::string, mixture_contact::PerSide<std::string>> pairs;
};

/// A degree of freedom that is given on some nodes: at the start, or always.
struct Condition {
  int dof = 0;
  std::vector<int> nodes;
  Parameter value;
  bool fixed = false;  ///< held at zero for good: FEBio reports no reaction there
};

/// A dead load on a surface in the reference configuration.
struct SurfaceLoad {
  bool fluid = false;  ///< outward volume flux of solvent [mm/s]; else a pressure on the mixture [MPa]
  std::vector<SurfaceFacet> facets;
  Parameter value;
};

/// FEBio's automatic time stepper.
struct StepControl {
  int max_retries = 5;
  int optimal_iterations = 11;
  double least = 0;      ///< dtmin [s]
  double largest = 0.1;  ///< dtmax [s], unless a must-point curve holds it
  int must_points = -1;  ///< load curve whose points must be met and whose values are the largest step; -1: none
  double cutback = 0.5;
  bool force = false;
};

/// Time steps, and Newton's method with FEBio's convergence tests.
struct Control {
  std::string module;
  double step_size = 0;  ///< [s]
  double end = 0;        ///< [s]
  std::optional<StepControl> stepper;
  int max_reformations = 15;
  double displacement_tolerance = 1e-3;
  double energy_tolerance = 1e-2;
  double residual_tolerance = 0;
  double pressure_tolerance = 1e-2;
  double concentration_tolerance = 1e-2;
  double least_residual = 1e-20;  ///< squared norm below which nothing acts on the system
  bool expects_positive = false;  ///< whether FEBio's solver would set negative concentrations to zero
  bool plot = true;
};

/// A contact interface or a tie.
struct ContactDefinition {
  std::string name;
  mixture_contact::PerSide<std::string> surfaces;
  ContactParameters parameters;
  Parameter ambient_pressure;                      ///< p* [MPa]
  std::map<int, Parameter> ambient_concentration;  ///< solute -> c* [mM]
};

struct ContactDefinitions {
  std::vector<ContactDefinition> sliding;
  std::vector<ContactDefinition> tied;
};

/// A file of node or element data.
struct DataFile {
  bool elements = false;
  std::vector<int> rows;  ///< of Model::node_data or element_data
  std::string names;      ///< as the model spells them
  std::string file;
  std::string separator = " ";
};

struct Model {
  std::string file;
  Control control;
  double gas_constant = 0;           ///< R [mJ/(nmol K)]
  double temperature = 0;            ///< [K]
  std::vector<std::string> solutes;  ///< their names; empty if one has none
  std::vector<Material> materials;
  Mesh mesh;
  std::vector<Condition> prescribed;
  std::vector<Condition> initial;
  std::vector<SurfaceLoad> loads;
  ContactDefinitions contacts;
  std::vector<LoadCurve> curves;
  std::vector<DataFile> data;
  std::vector<std::string> notices;  ///< notices for a user about parameters without effect

  const Material& material(const Element& element) const { return at(materials, element.material); }
  /// The data that a model may have in its log section, under FEBio's names: x y z, ux uy uz, p, c1 ..., Rx Ry Rz.
  std::vector<std::string> node_data() const;
  /// Likewise: p, wx wy wz, c1 j1x j1y j1z ..., and c jx jy jz of the first solute.
  std::vector<std::string> element_data() const;
  /// Number of rows of nodal values.
  int dofs() const { return concentration_dof(number_of(solutes)); }
  /// Place of a degree of freedom in a vector of all nodal values, node by node.
  int place(int dof, int node) const { return node * dofs() + dof; }
};

}  // namespace standalone
