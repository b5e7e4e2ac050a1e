/// Surfaces made of regular grids, flat or disturbed, and contacts between two of them, for the unit tests.
#pragma once

#include "contact/geometry/quadrature.h"
#include "contact/geometry/sub_facets.h"
#include "contact/interface/multipliers.h"
#include "contact/interface/output.h"
#include "random_contact.h"

#include <Eigen/Geometry>

#include <map>
#include <utility>

namespace test {

/// A rectangle in a plane z = const, divided into cells of one quadrilateral or two triangles each.
struct Grid {
  FacetType type = FacetType::quad4;
  int cells_x = 2;
  int cells_y = 2;
  Vector2d low{0, 0};
  Vector2d high{1, 1};
  double z = 0;
  bool faces_up = true;
};

/// A surface with uniform properties, and the positions of its nodes.
struct GridSurface {
  SurfaceMesh mesh;
  Matrix3Xd position;
};

/// An affine map from the parametric domain of a facet to half-cells.
struct CellPart {
  Vector2d origin;
  Vector2d first;
  Vector2d second;
};

inline std::vector<CellPart> cell_parts(FacetType type) {
  if (!is_triangle(type)) return {{{1, 1}, {1, 0}, {0, 1}}};
  return {{{0, 0}, {2, 0}, {2, 2}}, {{0, 0}, {2, 2}, {0, 2}}};
}

inline GridSurface grid_surface(const Grid& grid, int fields, double stiffness = 1, double conductance = 1) {
  GridSurface surface;
  constexpr int places = 6;                    // number per cell and direction; nodes are at halves and thirds
  std::map<std::pair<int, int>, int> numbers;  // numbers of the nodes, by their position in the grid
  std::vector<Vector3d> positions;
  const auto node_at = [&](const Vector2d& half_cells) {
    const Vector2d exact = half_cells * places / 2;
    const std::pair<int, int> place(static_cast<int>(std::lround(exact[0])), static_cast<int>(std::lround(exact[1])));
    const auto [entry, added] = numbers.insert({place, static_cast<int>(numbers.size())});
    if (added) {
      Vector2d share(place.first / (1.0 * places * grid.cells_x), place.second / (1.0 * places * grid.cells_y));
      if (!grid.faces_up) share[0] = 1 - share[0];  // a mirror image has the opposite normals
      const Vector2d flat = grid.low + share.cwiseProduct(grid.high - grid.low);
      positions.emplace_back(flat[0], flat[1], grid.z);
    }
    return entry->second;
  };
  for (int j = 0; j < grid.cells_y; ++j) {
    for (int i = 0; i < grid.cells_x; ++i) {
      for (const CellPart& part : cell_parts(grid.type)) {
        Facet facet;
        facet.type = grid.type;
        for (int a = 0; a < node_count(grid.type); ++a) {
          const Vector2d s = parametric_node(grid.type, a);
          facet.nodes[static_cast<std::size_t>(a)] = node_at(Vector2d(2 * i, 2 * j) + part.origin + s[0] * part.first +
                                                             s[1] * part.second);
        }
        surface.mesh.facets.push_back(facet);
      }
    }
  }
  const auto facets = static_cast<Index>(surface.mesh.facets.size());
  surface.mesh.nodes = static_cast<int>(positions.size());
  surface.mesh.permeable.assign(surface.mesh.facets.size(), ~FieldMask{0});
  surface.mesh.stiffness = VectorXd::Constant(facets, stiffness);
  surface.mesh.conductance = MatrixXd::Constant(fields, facets, conductance);
  surface.position.resize(3, surface.mesh.nodes);
  for (int node = 0; node < surface.mesh.nodes; ++node) {
    surface.position.col(node) = positions[static_cast<std::size_t>(node)];
  }
  return surface;
}

/// The solvent, if `solvent` is true, and solutes with the ids 0, 1, ...
inline Effects effects_of(bool solvent, int solutes) {
  Effects effects;
  effects.solvent = solvent;
  for (int id = 0; id < solutes; ++id) effects.solutes.push_back(id);
  return effects;
}

/// Two surfaces with their fields, and the settings of their contact.
struct Scene {
  PerSide<SurfaceMesh> mesh;
  PerSide<SurfaceFields> fields;
  Effects effects;
  Settings settings;

  Scene(const PerSide<Grid>& grids, const Effects& exchanged, const Settings& chosen = {})
      : effects(exchanged), settings(chosen) {
    for (const Side side : both_sides) {
      const GridSurface surface = grid_surface(grids[side], effects.scalar_fields());
      mesh[side] = surface.mesh;
      fields[side] = {surface.position, MatrixXd::Zero(surface.mesh.nodes, effects.nodal_fields())};
    }
  }

  PerSide<Matrix3Xd> position() const { return {{fields[Side::primary].position, fields[Side::secondary].position}}; }

  /// Flags of the nodes of both surfaces, all false.
  PerSide<NodeFlags> nowhere() const {
    return {{NodeFlags(mesh[Side::primary].nodes, false), NodeFlags(mesh[Side::secondary].nodes, false)}};
  }

  /// Displaces every node at random by up to `size`, and sets every field to random values between -1 and 1.
  void disturb(double size, std::mt19937& random) {
    for (SurfaceFields& field : fields) {
      for (Index node = 0; node < field.position.cols(); ++node)
        field.position.col(node) += random_vector(size, random);
      field.scalar = MatrixXd::NullaryExpr(field.scalar.rows(), field.scalar.cols(),
                                           [&] { return random_vector(1, random)[0]; });
    }
  }

  /// Sets a field to one value on each side.
  void set_field(Index field, double primary, double secondary) {
    fields[Side::primary].scalar.col(field).setConstant(primary);
    fields[Side::secondary].scalar.col(field).setConstant(secondary);
  }

  /// The contact of the scene, projected at the scene's positions.
  std::unique_ptr<ContactInterface> contact() const {
    auto result = std::make_unique<ContactInterface>(mesh, effects, settings);
    result->project(position());
    return result;
  }
};

/// Makes a contact behave as if a step had been accepted with infinite loads, and with all nodes flux-coupled.
inline void accept_any_load(ContactInterface& contact) {
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) {
    Multipliers& multipliers = contact.pass(pass).laws().multipliers;
    multipliers.accepted_traction.setConstant(-std::numeric_limits<double>::infinity());
    multipliers.flux_coupled.assign(multipliers.flux_coupled.size(), true);
  }
}

inline bool is_converged(const ContactInterface& contact, const GapReport& report) {
  return meets(report, contact.settings().tolerances, contact.effects());
}

/// Facing unit squares that overlap by `overlap`.
inline PerSide<Grid> facing_grids(FacetType one, FacetType two, double overlap, int cells_one = 2, int cells_two = 2) {
  Grid primary{one, cells_one, cells_one};
  Grid secondary{two, cells_two, cells_two};
  secondary.z = -overlap;
  secondary.faces_up = false;
  return {{primary, secondary}};
}

/// Two almost parallel surfaces of triangles with random fields, all of whose pairs are flat.
inline Scene flat_scene(const Effects& exchanged) {
  Settings settings;
  settings.integration = Integration::segments;
  Scene scene(facing_grids(FacetType::tri3, FacetType::tri3, 0.05, 3, 4), exchanged, settings);
  std::mt19937 random(3);
  scene.fields[Side::secondary].position.row(2) += random_values(scene.mesh[Side::secondary].nodes, -0.02, 0.02,
                                                                 random);
  for (SurfaceFields& fields : scene.fields) {
    for (Index k = 0; k < fields.scalar.cols(); ++k)
      fields.scalar.col(k) = random_values(fields.scalar.rows(), -1, 1, random);
  }
  return scene;
}

/// Rotates a surface about the z axis through the middle of the unit square.
inline void turn(Matrix3Xd& position, double angle) {
  const Vector3d middle(0.5, 0.5, 0);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  position = (rotation * (position.colwise() - middle)).colwise() + middle;
}

/// Settings with these penalties, for known loads.
inline Settings explicit_settings(double traction, double solvent, double solute) {
  Settings settings;
  settings.traction = {false, traction};
  settings.solvent = {false, solvent};
  settings.solute = {false, solute};
  settings.integration = Integration::gauss;
  return settings;
}

/// Settings with a search radius [length], for surfaces that are farther apart than the default search distance.
inline Settings looking_as_far_as(double radius, Settings settings) {
  settings.search.radius = radius;
  return settings;
}

/// The numbering of all unknowns of a scene: primary nodes first, each with its displacements and its fields; then the
/// multipliers, if they are unknowns.
struct GlobalLayout {
  PerSide<Index> nodes;
  Index fields;
  MultiplierLayout multipliers;

  explicit GlobalLayout(const Scene& scene)
      : nodes{{scene.mesh[Side::primary].nodes, scene.mesh[Side::secondary].nodes}},
        fields(scene.effects.nodal_fields()),
        multipliers(multiplier_layout(*scene.contact())) {}

  Index per_node() const { return 3 + fields; }
  Index nodal_size() const { return (nodes[Side::primary] + nodes[Side::secondary]) * per_node(); }
  Index size() const { return nodal_size() + multipliers.size(); }
  /// The entry of an unknown of a node. `component`: 0 to 2 for a displacement, 3 + k for field k.
  Index entry(Side side, Index node, Index component) const {
    return (node + (side == Side::primary ? 0 : nodes[Side::primary])) * per_node() + component;
  }

  /// The entries of a local vector, in its order.
  std::vector<Index> entries(const ContactInterface::Location& location) const {
    const LocalLayout local = location.patch.layout();
    std::vector<Index> result(static_cast<std::size_t>(local.size()), size());
    if (local.has_multipliers()) {
      const Index node = *location.patch.multiplier_node;
      if (local.has_displacements())
        result[static_cast<std::size_t>(local.traction_multiplier())] = nodal_size() + multipliers.traction(node);
      for (Index k = 0; k < local.scalar_fields(); ++k) {
        const int field = location.patch.fields[static_cast<std::size_t>(k)];
        result[static_cast<std::size_t>(local.flux_multiplier(k))] = nodal_size() + multipliers.flux(node, field);
      }
    }
    for (Index a = 0; a < local.nodes(); ++a) {
      const bool first = a < local.primary_nodes();
      const Side side = first ? location.first : other(location.first);
      const std::vector<int>& patch = first ? location.patch.primary : location.patch.secondary;
      const int node = patch[static_cast<std::size_t>(first ? a : a - local.primary_nodes())];
      for (Index i = 0; local.has_displacements() && i < 3; ++i) {
        result[static_cast<std::size_t>(local.displacement(a, i))] = entry(side, node, i);
      }
      for (Index k = 0; k < local.scalar_fields(); ++k) {
        result[static_cast<std::size_t>(local.scalar(a, k))] = entry(
            side, node, 3 + location.patch.fields[static_cast<std::size_t>(k)]);
      }
    }
    return result;
  }

  VectorXd pack(const PerSide<SurfaceFields>& values) const {
    VectorXd q(nodal_size());
    for (const Side side : both_sides) {
      for (Index node = 0; node < nodes[side]; ++node) {
        q.segment<3>(entry(side, node, 0)) = values[side].position.col(node);
        q.segment(entry(side, node, 3), fields) = values[side].scalar.row(node).transpose();
      }
    }
    return q;
  }

  PerSide<SurfaceFields> unpack(const VectorXd& q) const {
    PerSide<SurfaceFields> values;
    for (const Side side : both_sides) {
      values[side] = {Matrix3Xd(3, nodes[side]), MatrixXd(nodes[side], fields)};
      for (Index node = 0; node < nodes[side]; ++node) {
        values[side].position.col(node) = q.segment<3>(entry(side, node, 0));
        values[side].scalar.row(node) = q.segment(entry(side, node, 3), fields).transpose();
      }
    }
    return values;
  }
};

inline VectorXd assembled_residual(const ContactInterface& contact, const GlobalLayout& layout,
                                   const PerSide<SurfaceFields>& fields, double dt) {
  VectorXd sum = VectorXd::Zero(layout.size() + 1);
  contact.residual(fields, dt, [&](const ContactInterface::Location& location, const VectorXd& values) {
    sum(layout.entries(location)) += values;
  });
  return sum.head(layout.size());
}

inline MatrixXd assembled_tangent(const ContactInterface& contact, const GlobalLayout& layout,
                                  const PerSide<SurfaceFields>& fields, double dt) {
  MatrixXd sum = MatrixXd::Zero(layout.size() + 1, layout.size() + 1);
  using Location = ContactInterface::Location;
  contact.tangent(fields, dt, [&](const Location& rows, const Location& columns, const MatrixXd& values) {
    sum(layout.entries(rows), layout.entries(columns)) += values;
  });
  return sum.topLeftCorner(layout.size(), layout.size());
}

}  // namespace test
