// A table of numbers over time that a run which goes on takes up where its checkpoint was.
#pragma once

#include "granum/io/csv.hpp"
#include "granum/io/sections.hpp"

#include <memory>
#include <string>
#include <vector>

namespace granum::sim
{
//! On rank 0; elsewhere, or where it has no columns, nothing is written.
class KeptSeries
{
  public:
    KeptSeries() = default;
    //! Starts the file `path` anew; `kind` names it in a checkpoint. Throws base::IoError.
    KeptSeries(std::string const& path, std::string kind, std::vector<io::SeriesColumn> columns);

    bool writes() const { return file_ != nullptr; }
    void append(std::span<double const> row);
    std::size_t rows() const { return writes() ? values_.size() / columns_.size() : 0; }
    std::span<double const> row(std::size_t number) const;  //!< 0: the first

    void save(io::Sections& out) const;
    //! Writes the rows of a checkpoint, unless its columns were others: then the file begins with what comes now.
    void go_on(io::Sections const& saved);

  private:
    std::string head() const;  //!< the columns as text

    std::string kind_;
    std::vector<io::SeriesColumn> columns_;
    std::unique_ptr<io::SeriesWriter> file_;
    std::vector<double> values_;  //!< row after row
};
}
