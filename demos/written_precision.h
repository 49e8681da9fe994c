#pragma once
// How exactly a text file's numbers are written: programs print coordinates with a fixed number of digits, so
// that a face that was plane is bent by half of the last one. Tested in tests/demos/mesh_solid_test.cpp.

#include <filesystem>
#include <string_view>

namespace carom::demos {

/// Half of the last digit of the numbers that have the most digits, those that are cut off; 0 where no number
/// with a point has more than four digits (such are meant as they stand), and for what is no text.
double halfLastDigit(std::string_view text);

/// Of the first megabyte of a file.
double writtenError(const std::filesystem::path& path);

}  // namespace carom::demos
