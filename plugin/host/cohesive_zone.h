/// The conditions of a cohesive law on penalties and on the mesh.
#pragma once

#include "contact/tie/tie.h"
#include "facet_material.h"

#include <string>

/// The fault of the penalties of a cohesive tie, and the values that they have to exceed; empty if there is none.
std::string penalty_complaint(const mixture_contact::Tie& tie);

/// Facets that the zone in which a bond softens should span.
inline constexpr double facets_in_cohesive_zone = 3;

/// The length E G/sigma_c^2 of the zone in which a cohesive tie softens, the shorter of tension and shear [mm].
/// `modulus`: of the softer body [MPa].
double cohesive_zone(const mixture_contact::Cohesive& law, double modulus);

/// Says that facets are too long for the cohesive zone; empty if they are not. `position`: of the surfaces' nodes.
std::string cohesive_zone_line(const mixture_contact::Tie& tie, const FacetMaterials& materials,
                               const mixture_contact::PerSide<mixture_contact::Matrix3Xd>& position);
