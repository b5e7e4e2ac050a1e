/// A contact between two surfaces: what a host talks to.
#pragma once

#include "augmentation.h"

#include <array>
#include <functional>
#include <memory>

namespace mixture_contact {

/// The two surfaces of a contact, in the host's order.
enum class Side { primary = 0, secondary = 1 };
inline constexpr std::array<Side, 2> both_sides{Side::primary, Side::secondary};

template <class T>
class PerSide : public std::array<T, 2> {
 public:
  T& operator[](Side side) { return this->at(static_cast<std::size_t>(side)); }
  const T& operator[](Side side) const { return this->at(static_cast<std::size_t>(side)); }
};

inline Side other(Side side) { return side == Side::primary ? Side::secondary : Side::primary; }

/// What crosses the interface, as it acts on the primary surface; the secondary surface gets the exact opposite.
struct Balance {
  Vector3d force{0, 0, 0};  ///< contact force on the primary surface [N]
  double area = 0;          ///< area in contact [mm^2]
  VectorXd flow;            ///< flow out of the primary body per exchanged field [mm^3/s] or [nmol/s]
};

/// Values at the nodes of a surface for output, from the points in contact around each.
struct NodalOutput {
  VectorXd gap;       ///< [mm]
  VectorXd pressure;  ///< -t_n [MPa]
  MatrixXd flux;      ///< (fields, nodes), out of this surface's body
  MatrixXd jump;      ///< (fields, nodes), this side minus the other
  VectorXd coverage;  ///< area in contact that belongs to the node [mm^2]
};

/// A node of a surface is in contact, and so not at ambient conditions, where a facet around it is covered at least to this share
/// (see ContactPass::coverage). The node of a fully covered facet has 1; one that only the far points of its facets reach has about
/// 0.2 to 0.35. Exactly one half is common (a facet cut through the middle), so the bound is not put there.
inline constexpr double covered = 0.4;

/// A contact between two surfaces. Evaluations are const; project() sets the configuration, augment() the multipliers.
class ContactInterface {
 public:
  /// One facet pair's contribution: the sides of its two facets, their nodes and fields, and the values.
  struct Location {
    Side first;             ///< the side of `facets.primary`, the surface integrated over
    const FacetPair& facets;
  };
  using AddResidual = std::function<void(const Location&, const VectorXd&)>;
  using AddTangent = std::function<void(const Location&, const MatrixXd&)>;

  ContactInterface(PerSide<SurfaceMesh> mesh, Effects effects, Settings settings);
  ContactInterface(const ContactInterface&) = delete;
  ContactInterface& operator=(const ContactInterface&) = delete;

  /// Whether a projection looks for the facet anew or keeps to the one that a point saw last.
  enum class Search { everywhere, same_facets };

  /// Sets the configuration: search and projection. Nothing happens if that has been done for these positions.
  void project(const PerSide<Matrix3Xd>& position, Search search = Search::everywhere);

  /// Positions of the primary nodes with those that overlap the secondary surface moved onto it along their normals.
  Matrix3Xd without_overlap(const PerSide<Matrix3Xd>& position) const;

  void residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const;
  void tangent(const PerSide<SurfaceFields>& fields, double dt, const AddTangent& add) const;
  void for_each_facet_pair(const std::function<void(const Location&)>& use) const;

  /// Gaps at the current state, and whether they meet the tolerances; the worst of both passes.
  GapReport gaps(const PerSide<SurfaceFields>& fields) const;
  bool converged(const GapReport& report) const { return meets(report, settings_.tolerances, effects_); }

  /// One augmentation: multipliers take the current loads, and slow fields a larger penalty.
  void augment(const PerSide<SurfaceFields>& fields);

  /// Which nodes of each surface are in contact in the current configuration.
  PerSide<std::vector<bool>> nodes_in_contact() const;

  Balance balance(const PerSide<SurfaceFields>& fields) const;
  NodalOutput nodal_output(Side side, const PerSide<SurfaceFields>& fields) const;

  /// Replaces stiffness and conductance of a surface's facets and recomputes the penalties.
  void update_properties(PerSide<VectorXd> stiffness, PerSide<MatrixXd> conductance);

  const Effects& effects() const { return effects_; }
  const Settings& settings() const { return settings_; }
  const SurfaceMesh& mesh(Side side) const { return mesh_[side]; }
  const ContactPass& pass(std::size_t index) const { return *passes_[index].integral; }
  std::size_t passes() const { return passes_.size(); }
  /// Multipliers of a pass: all the state there is, to be stored and restored by the host.
  Multipliers& multipliers(std::size_t index) { return passes_[index].integral->multipliers; }

 private:
  struct Pass {
    Side side;  ///< the surface integrated over
    std::unique_ptr<ContactPass> integral;
  };

  double search_radius(const PerSide<Matrix3Xd>& position) const;
  VectorXd projected_coverage(Side side, const VectorXd& other_coverage) const;

  PerSide<SurfaceMesh> mesh_;
  Effects effects_;
  Settings settings_;
  std::vector<Pass> passes_;
  PerSide<Matrix3Xd> position_;
  bool searched_ = false;  ///< whether the last projection was a search everywhere
};

}  // namespace mixture_contact
