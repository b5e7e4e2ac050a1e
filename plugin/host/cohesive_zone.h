/// Requirements of a cohesive law on penalties and on the mesh.
#pragma once

#include "contact/tie/tie.h"
#include "facet_material.h"

#include <string>

/// A message that names the penalties of a cohesive tie that are too small, and the values that they have to exceed;
/// empty if there are none.
std::string penalty_complaint(const mixture_contact::Tie& tie);

/// Number of facets that should cover the cohesive zone, in which a bond softens.
inline constexpr double facets_in_cohesive_zone = 3;

/// The length E G/sigma_c^2 of the cohesive zone of a tie, the shorter one of tension and shear [mm]. `modulus`: E of
/// the softer body [MPa].
double cohesive_zone(const mixture_contact::Cohesive& law, double modulus);

/// A line for the log if facets are too long for the cohesive zone; else empty. `position`: positions of the surfaces'
/// nodes.
std::string cohesive_zone_line(const mixture_contact::Tie& tie, const FacetMaterials& materials,
                               const mixture_contact::PerSide<mixture_contact::Matrix3Xd>& position);

/// Reports that a step failed in which bonds of a cohesive tie soften, with a remedy. `tie`: type and name of the tie.
std::string failed_softening_line(const std::string& tie);
