#pragma once
// The impulses that a pair's rows start from: those of the last step. A point is known again by its name;
// where corners of equal faces coincide, by its place; and between bodies that lie still, where the manifold
// has chosen others among many corners, the points together take over what those that went have carried: what
// stands is not disturbed by what its contacts are called. (Where bodies move, a point that went has gone,
// and handing on what it carried would feed their motion.) Internal to the simulation floor. Tested in
// tests/engine/simulation/contacts/warm_start_test.cpp.

#include <span>

#include "engine/simulation/contacts/contact_rows.h"

namespace carom {

/// Sets the rows' impulses. `still`: both bodies of the pair lie still. `rows`: all of this pair, prepared.
void warmStart(const ShapePair& pair, bool still, std::span<SourcedRow> rows);

}  // namespace carom
