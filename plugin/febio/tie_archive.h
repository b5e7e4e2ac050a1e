/// Storage of a tie in FEBio's dump streams: the tied nodes, and their state.
#pragma once

#include "contact/tie/tie.h"

#include <memory>

class DumpStream;

/// Writes surfaces, effects and tied nodes to an archive, or makes a tie from an archive. `breaking`: law by which the
/// tie breaks.
void archive_tie(DumpStream& ar, std::unique_ptr<mixture_contact::Tie>& tie,
                 const mixture_contact::BreakingLaw& breaking);
void archive_state(DumpStream& ar, mixture_contact::TieState& state);
