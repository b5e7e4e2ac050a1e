#include "material_properties.h"

#include <FEBioMech/FEElasticMaterial.h>
#include <FEBioMech/FERigidMaterial.h>
#include <FEBioMix/FEBiphasic.h>
#include <FEBioMix/FEBiphasicSolute.h>
#include <FEBioMix/FEMultiphasic.h>
#include <FEBioMix/FESolute.h>
#include <FEBioMix/FESoluteInterface.h>
#include <FEBioMix/FETriphasic.h>
#include <FECore/FEMaterial.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FESolidDomain.h>
#include <FECore/FESolidElement.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace {

/// A copy of an element's first material point in the undeformed state.
std::unique_ptr<FEMaterialPoint> reference_copy(FEMaterialPoint& original) {
  std::unique_ptr<FEMaterialPoint> copy(original.Copy());
  copy->m_elem = original.m_elem;
  copy->m_index = original.m_index;
  copy->m_r0 = original.m_r0;
  copy->m_rt = original.m_r0;
  if (auto* elastic = copy->ExtractData<FEElasticMaterialPoint>()) {
    elastic->m_F = mat3dd(1.0);
    elastic->m_J = 1.0;
    elastic->m_s.zero();
  }
  return copy;
}

/// The mean of the reference positions of an element's nodes.
vec3d centre(FEModel& fem, const FEElement& element) {
  vec3d sum(0, 0, 0);
  for (const int node : element.m_node) sum += fem.GetMesh().Node(node).m_r0;
  return sum / element.Nodes();
}

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The inverse of a symmetric matrix, with the absolute values of its eigenvalues.
Matrix6d positive_inverse(const Matrix6d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> found(matrix);
  return found.eigenvectors() * found.eigenvalues().cwiseAbs().cwiseInverse().asDiagonal() *
         found.eigenvectors().transpose();
}

/// Young's modulus along n of an elasticity tensor: the inverse of the component (n n):S:(n n) of the compliance S,
/// where S:(n n) is the strain under the stress n n. In Voigt notation, from engineering strains to stresses. A
/// material under active stress may have negative eigenvalues; their absolute values count.
double modulus_along(const vec3d& n, const tens4ds& elasticity) {
  using Voigt = Eigen::Matrix<double, 6, 1>;
  const Voigt stress{{n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.y * n.z, n.x * n.z}};
  Matrix6d stiffness;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) stiffness(i, j) = elasticity(i, j);
  }
  if (stiffness.llt().info() == Eigen::Success) return 1.0 / stress.dot(stiffness.partialPivLu().solve(stress));
  return 1.0 / stress.dot(positive_inverse(stiffness) * stress);
}

/// Porosity of any mixture material; 0 for other materials.
double porosity(FEMaterial& material, FEMaterialPoint& point) {
  if (auto* m = dynamic_cast<FEBiphasic*>(&material)) return m->Porosity(point);
  if (auto* m = dynamic_cast<FEBiphasicSolute*>(&material)) return m->Porosity(point);
  if (auto* m = dynamic_cast<FETriphasic*>(&material)) return m->Porosity(point);
  if (auto* m = dynamic_cast<FEMultiphasic*>(&material)) return m->Porosity(point);
  return 0;
}

FEHydraulicPermeability* permeability_of(FEMaterial& material) {
  if (auto* m = dynamic_cast<FEBiphasic*>(&material)) return m->GetPermeability();
  if (auto* m = dynamic_cast<FEBiphasicSolute*>(&material)) return m->GetPermeability();
  if (auto* m = dynamic_cast<FETriphasic*>(&material)) return m->GetPermeability();
  if (auto* m = dynamic_cast<FEMultiphasic*>(&material)) return m->GetPermeability();
  return nullptr;
}

double stiffness_of(const MaterialParts& parts, FEMaterialPoint& point, const vec3d& n) {
  if (parts.rigid != nullptr) return std::numeric_limits<double>::infinity();
  return parts.solid == nullptr ? 0 : modulus_along(n, parts.solid->Tangent(point));
}

/// The modulus along x of the first element of a domain; 0 if it has none.
double modulus_of(FEDomain& domain) {
  if (dynamic_cast<FESolidDomain*>(&domain) == nullptr || domain.Elements() == 0) return 0;
  if (domain.GetMaterial() == nullptr) return 0;
  const MaterialParts parts = parts_of(*domain.GetMaterial());
  if (parts.rigid != nullptr) return parts.rigid->m_E / (1 - parts.rigid->m_v * parts.rigid->m_v);
  if (parts.solid == nullptr) return 0;
  const std::unique_ptr<FEMaterialPoint> point = reference_copy(*domain.ElementRef(0).GetMaterialPoint(0));
  const double modulus = stiffness_of(parts, *point, {1, 0, 0});
  return std::isfinite(modulus) ? modulus : 0;
}

/// The mean of the solvent flux at an element's material points.
vec3d mean_flow(FEElement& element) {
  vec3d sum(0, 0, 0);
  for (int i = 0; i < element.GaussPoints(); ++i) {
    const auto* point = element.GetMaterialPoint(i)->ExtractData<FEBiphasicMaterialPoint>();
    if (point != nullptr) sum += point->m_w;
  }
  return sum / element.GaussPoints();
}

/// The solute conductance from diffusion and convection: phi_w kappa~ d + kappa~ (d/d0) |w_n| h, divided by the
/// thickness h.
double solute_conductance(FEMaterial& material, const FESolute& solute, FEMaterialPoint& point, const vec3d& n,
                          double convection, double thickness) {
  const double diffusivity = n * (solute.m_pDiff->Diffusivity(point) * n);
  const double solubility = solute.m_pSolub->Solubility(point);
  const double free = solute.m_pDiff->Free_Diffusivity(point);
  const double hindrance = free > 0 ? diffusivity / free : 1.0;
  return solubility * (porosity(material, point) * diffusivity / thickness + hindrance * convection);
}

/// A facet and the element behind it, in the reference configuration.
struct FacetGeometry {
  FEElement* element = nullptr;
  double volume = 0;
  double thickness = 0;  ///< volume of the element divided by the area of the facet
  vec3d normal;
};

FacetGeometry geometry_of(FEModel& fem, FESurface& surface, FESurfaceElement& facet, FEElement& element) {
  const double volume = fem.GetMesh().ElementVolume(element);
  vec3d tangents[2];
  surface.CoBaseVectors0(facet, 0, tangents);
  vec3d n = tangents[0] ^ tangents[1];
  n.unit();
  return {&element, volume, std::abs(volume) / surface.FaceArea(facet), n};
}

/// The fault of a facet and its element; empty if there is none.
std::string problem_of(FEModel& fem, const FESurfaceElement& facet, const FacetGeometry& geometry, bool is_rigid) {
  const std::string element = "element " + std::to_string(geometry.element->GetID());
  if (!is_rigid && (!(geometry.thickness > 0) || geometry.volume < 0))
    return element + " behind a facet has no positive volume (inverted or degenerate)";
  // A shell has faces on both of its sides.
  if (geometry.element->Class() == FE_ELEM_SHELL) return "";
  if (!(geometry.normal * (centre(fem, facet) - centre(fem, *geometry.element)) < 0)) return "";
  return "the facet on " + element +
         " is inverted: its nodes must run counter-clockwise seen from outside the body (<flip_primary> and "
         "<flip_secondary> reverse whole surfaces)";
}

/// The material of a facet in the undeformed state. Its stiffness is not positive if the material is not supported.
FacetMaterial properties_of(const MaterialParts& parts, const FacetGeometry& geometry) {
  FacetMaterial result;
  result.thickness = geometry.thickness;
  result.stiffness = std::numeric_limits<double>::infinity();
  if (parts.rigid != nullptr) return result;
  const vec3d n = geometry.normal;
  const std::unique_ptr<FEMaterialPoint> point = reference_copy(*geometry.element->GetMaterialPoint(0));
  const double modulus = stiffness_of(parts, *point, n);
  result.stiffness = modulus / geometry.thickness;
  if (modulus > 0) result.crossing = geometry.thickness * std::sqrt(parts.solid->Density(*point) / modulus);
  if (parts.permeability != nullptr) {
    result.permeable = true;
    result.permeability = n * (parts.permeability->Permeability(*point) * n) / geometry.thickness;
  }
  if (parts.solutes == nullptr) return result;
  const double convection = std::abs(mean_flow(*geometry.element) * n);
  for (int k = 0; k < parts.solutes->Solutes(); ++k) {
    FESolute& solute = *parts.solutes->GetSolute(k);
    result.solutes[solute.GetSoluteID() - 1] = solute_conductance(*parts.material, solute, *point, n, convection,
                                                                  geometry.thickness);
  }
  return result;
}

}  // namespace

MaterialParts parts_of(FEMaterial& material) {
  return {&material, dynamic_cast<FERigidMaterial*>(&material), material.ExtractProperty<FEElasticMaterial>(),
          permeability_of(material), dynamic_cast<FESoluteInterface*>(&material)};
}

std::optional<FacetMaterial> MaterialReader::behind(FEModel& fem, FESurface& surface, FESurfaceElement& facet,
                                                    std::string& problem) {
  FEElement* element = facet.m_elem[0].pe;
  if (element == nullptr) {
    problem = "a facet of the surface is not a face of any element";
    return std::nullopt;
  }
  FacetGeometry geometry = geometry_of(fem, surface, facet, *element);
  FEMaterial& material = *fem.GetMaterial(element->GetMatID());
  if (last_.material != &material) last_ = parts_of(material);
  problem = problem_of(fem, facet, geometry, last_.rigid != nullptr);
  if (!problem.empty()) return std::nullopt;
  // The size of the facet replaces the thickness, which rigid shells may lack.
  if (!(geometry.thickness > 0)) geometry.thickness = std::sqrt(surface.FaceArea(facet));
  FacetMaterial result = properties_of(last_, geometry);
  if (result.stiffness > 0) return result;
  problem =
      "material \"" + material.GetName() + "\" (" + std::string(material.GetTypeStr()) +
      ") is not supported. The contact supports elastic, rigid, biphasic, biphasic-solute, triphasic and multiphasic materials";
  return std::nullopt;
}

double modulus_of_rigid_bodies(FEModel& fem) {
  double largest = 0;
  for (int i = 0; i < fem.GetMesh().Domains(); ++i) largest = std::max(largest, modulus_of(fem.GetMesh().Domain(i)));
  return largest;
}

std::vector<std::string> solute_names(FEModel& fem) {
  std::vector<std::string> names;
  for (int i = 0; i < fem.GlobalDataItems(); ++i) {
    if (const auto* solute = dynamic_cast<FESoluteData*>(fem.GetGlobalData(i))) names.push_back(solute->GetName());
  }
  return names;
}
