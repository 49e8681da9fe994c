#pragma once
// The coordinates of a text file as they are written, and how exactly: assimp rounds them to single
// precision, and programs print them with a fixed number of digits, so that a face that was plane is bent by
// half of the last one. Tested in tests/demos/asset/mesh_solid_test.cpp.

#include <string_view>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom::demos {

/// Half of the last digit of the numbers that have the most digits, those that are cut off; 0 where no number
/// with a point has more than four digits (such are meant as they stand), and for what is no text.
double halfLastDigit(std::string_view text);

/// Whether some number has more digits than single precision needs: then it was not printed from that.
bool hasDoubleDigits(std::string_view text);

/// The vertices of a mesh in text (OBJ, OFF, PLY, STL) in double precision, in the file's order; none of any
/// other, or where the text is not as its format says.
std::vector<Vec3> writtenVertices(std::string_view text);

/// Gives each point the coordinates of the written vertex that it is the rounding of, within a millionth of
/// the largest coordinate. False, with nothing changed, where there is none, or more than one.
bool takeWritten(const std::vector<Vec3>& written, std::vector<Vec3*>& points);

}  // namespace carom::demos
