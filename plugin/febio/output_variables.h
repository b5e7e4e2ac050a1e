/// Plot and log variables of the contact in addition to those of FEBio's contact base classes.
#pragma once

#include <FECore/FEPlotData.h>
#include <FECore/FaceDataRecord.h>
#include <FECore/SurfaceDataRecord.h>

class FECoreKernel;
class FEMixtureSurface;

/// Registers all plot and log variables with FEBio.
///
/// Plot file, nodal, per surface: "contact solvent flux", "contact solvent jump", "contact solute flux" and "contact
/// solute jump" (one entry per solute), "contact coverage". Plot file, one value per surface: "contact solvent flow",
/// "contact solute flow" (one entry per solute). Log file, surface_data: "contact_force.x" (.y, .z), "contact solvent
/// flow", "contact solute flow 1" (to 8). Log file, face_data: "contact solvent flux", "contact solvent jump", "contact
/// solute flux 1", "contact solute jump 1" (to 8).
///
/// Fluxes and flows are positive out of the body of the surface. Jumps are values of the surface minus those of the
/// other side.
void register_output_variables();
