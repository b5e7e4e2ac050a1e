/// Storage of the input and state of a contact core in FEBio's dump streams.
#pragma once

#include "contact/interface/interface.h"

class DumpStream;

void archive_mesh(DumpStream& ar, mixture_contact::SurfaceMesh& mesh);
void archive_effects(DumpStream& ar, mixture_contact::Effects& effects);
/// Writes the state of a contact core to an archive, or reads it.
void archive_state(DumpStream& ar, mixture_contact::ContactInterface::State& state);
