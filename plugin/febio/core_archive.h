/// Storage of the core's input, and its state, in FEBio's dump streams.
#pragma once

#include "contact/interface/interface.h"

class DumpStream;

void archive_mesh(DumpStream& ar, mixture_contact::SurfaceMesh& mesh);
void archive_effects(DumpStream& ar, mixture_contact::Effects& effects);
/// `effects`: of the contact that the state is of.
void archive_state(DumpStream& ar, mixture_contact::ContactInterface::State& state,
                   const mixture_contact::Effects& effects);
