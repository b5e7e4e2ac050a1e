/// A model as its file describes it: plain data that the reader has checked.
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

/// Row of p~ in a matrix of nodal values. The rows are displacements u [mm], effective fluid pressure p~ [MPa],
/// effective concentrations c~ [mM].
inline constexpr int pressure_dof = 3;
/// Row of a solute's c~ in a matrix of nodal values.
constexpr int concentration_dof(int solute) { return 4 + solute; }

/// Number of c~ among the fields of a material: u1 u2 u3, p~ if it is porous, c~ if it has a solute.
inline constexpr int solute_field = 4;
/// Largest number of fields of a material.
inline constexpr int max_fields = 5;

/// A function of time: linear between points, or constant up to the next point; constant outside of the first and last
/// point.
struct LoadCurve {
  std::vector<std::array<double, 2>> points;  ///< (time [s], value), times ascending
  /// True: constant up to the next point.
  bool steps = false;

  /// The value at a time [s].
  double at(double time) const;
};

/// A value that may be multiplied by a load curve.
struct Parameter {
  double value = 0;
  int curve = -1;  ///< index of the load curve; -1 if there is none

  /// The value at a time [s].
  double at(double time, const std::vector<LoadCurve>& curves) const;
};

/// The properties of a solute in one material.
struct Solute {
  int index = 0;                ///< index in the model's list of solutes, from 0
  double diffusivity = 0;       ///< diffusivity d in the mixture [mm^2/s]
  double free_diffusivity = 0;  ///< diffusivity d0 in the solvent [mm^2/s]
  double solubility = 1;        ///< effective solubility kappa~: c = kappa~ c~ [-]
};

/// A neo-Hookean solid, alone or as the matrix of a mixture, or a rigid body.
struct Material {
  std::string name;
  bool rigid = false;
  bool porous = false;
  double modulus = 0;         ///< Young's modulus at small strain [MPa]
  double poisson = 0;         ///< Poisson's ratio [-]
  double solid_fraction = 0;  ///< volume fraction phi_s of the solid in the reference configuration [-]
  double permeability = 0;    ///< hydraulic permeability k [mm^4/(N s)]
  double osmotic = 1;         ///< osmotic coefficient Phi [-]
  std::optional<Solute> solute;

  /// The number of its fields.
  int fields() const { return solute ? max_fields : (porous ? 4 : 3); }
  /// The row of a field in a matrix of nodal values.
  int dof(int field) const { return field < solute_field || !solute ? field : concentration_dof(solute->index); }
};

/// A hexahedron in FEBio's node order with 8 nodes, or 20 with mid-edge nodes.
struct Element {
  int id = 0;
  int material = 0;
  std::vector<int> nodes;
  int line = 0;  ///< line in the model file
};

/// A facet of a surface with the element behind it. Nodes are indices in the mesh.
struct SurfaceFacet {
  mixture_contact::Facet facet;
  int element = -1;
  /// Number of the element's face that is the facet.
  int face = 0;
};

/// The mesh of a model with its named parts.
struct Mesh {
  Matrix3Xd nodes;  ///< reference positions [mm]
  std::vector<Element> elements;
  std::map<std::string, std::vector<int>> parts;  ///< elements of each <Elements> section, by name
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<SurfaceFacet>> surfaces;
  std::map<std::string, mixture_contact::PerSide<std::string>> pairs;
};

/// A value of a degree of freedom at nodes: prescribed in all steps, or as an initial condition.
struct Condition {
  int dof = 0;
  std::vector<int> nodes;
  Parameter value;
  bool fixed = false;  ///< fixed to zero; FEBio reports no reaction for it
};

/// A dead load on a surface, per area of the reference configuration.
struct SurfaceLoad {
  bool fluid = false;  ///< true: outward volume flux of solvent [mm/s]; false: pressure on the mixture [MPa]
  std::vector<SurfaceFacet> facets;
  Parameter value;
};

/// The settings of FEBio's automatic time stepper.
struct StepControl {
  int max_retries = 5;
  int optimal_iterations = 11;
  double least = 0;      ///< smallest time step dtmin [s]
  double largest = 0.1;  ///< largest time step dtmax [s], unless a must-point curve gives it
  /// Index of the load curve whose points must be met and whose values are the largest step; -1: none.
  int must_points = -1;
  double cutback = 0.5;
  bool force = false;
};

/// The settings of time steps and of Newton's method with FEBio's convergence tests.
struct Control {
  std::string module;
  double step_size = 0;  ///< initial time step [s]
  double end = 0;        ///< end time [s]
  std::optional<StepControl> stepper;
  int max_reformations = 15;
  double displacement_tolerance = 1e-3;
  double energy_tolerance = 1e-2;
  double residual_tolerance = 0;
  double pressure_tolerance = 1e-2;
  double concentration_tolerance = 1e-2;
  double least_residual = 1e-20;  ///< squared norm of the residual below which it counts as zero
  bool expects_positive = false;  ///< true if FEBio's solver would set negative concentrations to zero
  bool plot = true;
};

/// A sliding contact or a tie.
struct ContactDefinition {
  std::string name;
  mixture_contact::PerSide<std::string> surfaces;
  ContactParameters parameters;
  Parameter ambient_pressure;                      ///< ambient pressure p* [MPa]
  std::map<int, Parameter> ambient_concentration;  ///< ambient concentrations c* by solute index [mM]
};

/// All contacts of a model.
struct ContactDefinitions {
  std::vector<ContactDefinition> sliding;
  std::vector<ContactDefinition> tied;
};

/// A file for the output of nodal or element data.
struct DataFile {
  bool elements = false;
  std::vector<int> rows;  ///< rows of Model::node_data() or element_data()
  std::string names;      ///< names of the data as the model spells them
  std::string file;
  std::string separator = " ";
};

/// A model with all its parts.
struct Model {
  std::string file;
  Control control;
  double gas_constant = 0;           ///< gas constant R [mJ/(nmol K)]
  double temperature = 0;            ///< temperature [K]
  std::vector<std::string> solutes;  ///< names of the solutes; empty for a solute without a name
  std::vector<Material> materials;
  Mesh mesh;
  std::vector<Condition> prescribed;
  std::vector<Condition> initial;
  std::vector<SurfaceLoad> loads;
  ContactDefinitions contacts;
  std::vector<LoadCurve> curves;
  std::vector<DataFile> data;
  std::vector<std::string> notices;  ///< notices for the user about parameters without effect

  const Material& material(const Element& element) const { return at(materials, element.material); }
  /// The names of nodal data for the log section, as in FEBio: x y z, ux uy uz, p, c1 ..., Rx Ry Rz.
  std::vector<std::string> node_data() const;
  /// The names of element data for the log section, as in FEBio: p, wx wy wz, c1 j1x j1y j1z ..., and c jx jy jz of the
  /// first solute.
  std::vector<std::string> element_data() const;
  /// The number of rows of a matrix of nodal values.
  int dofs() const { return concentration_dof(number_of(solutes)); }
  /// The index of a nodal value in a vector of all nodal values, node by node.
  int place(int dof, int node) const { return node * dofs() + dof; }
};

}  // namespace standalone
