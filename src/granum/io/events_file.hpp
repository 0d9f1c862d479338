// The event file: one row per dried deposit, one HDF5 data set per column, so that h5py reads a column in one line.
#pragma once

#include "granum/io/hdf5_file.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace granum::io
{
struct EventColumn
{
    std::string name;  //!< name of the data set under /events
    std::string unit;  //!< its attribute "unit"; "1" for pure numbers
    std::string doc;   //!< its attribute "doc", one sentence
};

//! Appends rows to the columns of /events.
//!
//! Rows are kept in memory until `flush` or until there are some thousands; what was flushed stays readable if the
//! program is killed.
class EventsWriter
{
  public:
    //! Starts `path` anew. Throws base::IoError, here and below, naming the file.
    EventsWriter(std::string const& path, std::vector<EventColumn> const& columns);
    ~EventsWriter();
    EventsWriter(EventsWriter const&) = delete;
    EventsWriter& operator=(EventsWriter const&) = delete;

    //! @param rows any number of whole rows, row after row
    void append(std::span<double const> rows);
    void flush();
    //! Rows appended so far, flushed or not.
    std::size_t rows() const { return written_ + waiting_.size() / columns_.size(); }

  private:
    std::string path_;
    std::vector<EventColumn> columns_;
    Hdf5Handle file_;
    std::vector<Hdf5Handle> sets_;
    std::vector<double> waiting_;
    std::size_t written_ = 0;
};

struct EventTable
{
    std::vector<EventColumn> columns;
    std::vector<std::vector<double>> values;  //!< per column

    std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
    //! The column called `name`, or nothing.
    std::vector<double> const* find(std::string const& name) const;
};

//! All events of `path`, columns in the order they were declared. Rows that a killed run wrote only in part are left
//! out.
EventTable read_events(std::string const& path);
}
