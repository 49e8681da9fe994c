#pragma once
// Golden images replaced by what was rendered: those that the gate refuses, and those that a new record is
// not of, each whole or not at all, byte for byte, so that text chunks with the frame's identity come along.
// A golden image whose counterpart is missing is never deleted. Tested in
// tests/demos/compare/golden_update_test.cpp.

#include <string>

#include "demos/compare/comparison.h"

namespace carom::demos {

enum class Update {
  kNone,  ///< The gate lets the golden image pass as it is.
  kReplaced,
  kAdded,
  kRefused  ///< There is no whole image to put in its place.
};

/// What the gate's verdict calls for.
Update plannedUpdate(const Comparison& comparison);
bool writesGolden(Update update);

/// Puts the actual file in the golden one's place. Throws CannotWrite, and InputError when the actual file
/// has gone since it was compared.
void replaceGolden(const ImagePair& pair);

/// Whether the actual frames have a record beside them (cause/motion_record.h) that is not, byte for byte,
/// that of the golden ones.
bool hasOtherRecord(const ImagePair& pair);

/// Puts that record beside the golden frames. Throws CannotWrite.
void updateRecord(const ImagePair& pair);

/// "replaced", "added", "kept" or "" for none.
const char* updateName(Update update);

}  // namespace carom::demos
