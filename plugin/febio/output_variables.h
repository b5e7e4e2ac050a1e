/// Plot and log variables of the contact, beyond those that FEBio's contact base classes provide.
#pragma once

#include <FECore/FEPlotData.h>
#include <FECore/FaceDataRecord.h>
#include <FECore/SurfaceDataRecord.h>

class FECoreKernel;
class FEMixtureSurface;

/// Registers all plot and log variables with FEBio:
///
/// plot file, nodal, per surface: "contact solvent flux", "contact solvent jump", "contact solute flux" and "contact
/// solute jump" (one entry per solute), "contact coverage"; one value per surface: "contact solvent flow", "contact
/// solute flow" (one entry per solute); log file, surface_data: "contact_force.x" (.y, .z), "contact solvent flow",
/// "contact solute flow 1" (to 8); log file, face_data: "contact solvent flux", "contact solvent jump", "contact solute
/// flux 1", "contact solute jump 1" (to 8).
///
/// Fluxes and flows are positive out of the body that owns the surface; jumps are its value minus the other side's.
void register_output_variables();
