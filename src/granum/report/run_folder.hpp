// What a run left behind, read as far as it is there: a report of half a run is better than none.
#pragma once

#include "granum/io/csv.hpp"
#include "granum/io/events_file.hpp"
#include "granum/io/snapshot_file.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granum::report
{
struct RunFolder
{
    std::string path;
    nlohmann::json summary = nlohmann::json::object();
    io::Series series;
    io::EventTable events;
    std::optional<io::Snapshot> snapshot;
    std::string resolved_case;          //!< text of case.toml
    std::vector<std::string> warnings;  //!< of the run, from the summary or the log
    std::vector<std::string> missing;   //!< files that could not be read, with the reason

    //! Number at a dotted key of the summary ("balance.eta").
    std::optional<double> value(std::string_view key) const;
    //! Text at a dotted key of the summary, or `otherwise`.
    std::string text(std::string_view key, std::string const& otherwise) const;
    //! The object or array at a dotted key; null where there is none.
    nlohmann::json const& at(std::string_view key) const;

    //! The run had neither gas nor spray.
    bool granules_alone() const { return at("packing").is_object() && !value("gas.cells"); }

    //! First of `names` that is a column of the time series, or nothing.
    std::vector<double> const* column(std::initializer_list<char const*> names) const;
    //! Events that count: those of the spray; those of the quasi-steady start only while there are no others.
    std::vector<std::size_t> event_rows() const;
    //! A column of the events at `rows`; empty if there is no such column.
    std::vector<double> event_values(char const* name, std::vector<std::size_t> const& rows) const;
};

//! Reads the folder `path`. Throws base::IoError if it is not a folder; anything missing inside is listed instead.
RunFolder read_run(std::string const& path);
}
