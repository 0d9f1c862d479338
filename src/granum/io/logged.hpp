// Curves that a plant's logger or a spreadsheet exported: whatever its delimiter, decimal mark and units.
#pragma once

#include "granum/io/csv.hpp"
#include "granum/io/units.hpp"

#include <map>
#include <string>

namespace granum::io
{
//! Reads a table of numbers whose first row names the columns with their unit, "exhaust temperature [degC]" or
//! "time (min)"; where no name has a unit, a second row of units may follow, as in timeseries.csv. Fields are divided
//! by semicolons, tabs or commas, whichever the first row holds; where it is not commas, 1,5 is one and a half. Lines
//! that begin with # and empty lines are left out, an empty field is NaN.
//!
//! Only columns of `known` (by name: lower case, words joined with underscores) are read, into SI; the others are named
//! in `left`. Throws base::CaseError with file, line and what is wrong.
Series read_logged(std::string const& path, std::map<std::string, Dimension> const& known,
                   std::vector<std::string>& left);
}
