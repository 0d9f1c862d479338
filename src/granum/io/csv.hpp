// Time series as CSV that any spreadsheet opens: names in the first row, units in the second, numbers below.
#pragma once

#include <cstddef>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace granum::io
{
struct SeriesColumn
{
    std::string name;  //!< lower case with underscores: "bed_temperature"
    std::string unit;  //!< "K"; "1" for pure numbers
};

//! Writes a table row by row; every row is on the disk when `append` returns.
class SeriesWriter
{
  public:
    //! Starts `path` anew. Throws base::IoError if it cannot be written.
    SeriesWriter(std::string const& path, std::vector<SeriesColumn> const& columns);
    //! @param row one number per column; NaN is written as an empty field
    void append(std::span<double const> row);

  private:
    std::string path_;
    std::size_t width_;
    std::ofstream out_;
};

//! A table in memory, column by column.
struct Series
{
    std::vector<SeriesColumn> columns;
    std::vector<std::vector<double>> values;  //!< per column; an empty field is NaN

    std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
    //! The column called `name`, or nothing.
    std::vector<double> const* find(std::string const& name) const;
};

//! Reads what SeriesWriter wrote. A last row without its line end (of a killed run) is left out.
//! Throws base::IoError with file and line if the file is missing or a field is not a number.
Series read_series(std::string const& path);
}
