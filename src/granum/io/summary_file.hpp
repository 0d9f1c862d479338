// summary.json of a run folder, and the way to a value in it.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace granum::io
{
//! Throws base::IoError where the file is missing or not JSON.
nlohmann::json read_summary(std::string const& folder);

//! What stands at a dotted key ("balance.eta"); null where there is nothing.
nlohmann::json const& at(nlohmann::json const& summary, std::string_view key);

//! The number at a dotted key; nothing where there is none (or one that is not finite, which JSON writes as null).
std::optional<double> number_at(nlohmann::json const& summary, std::string_view key);
}
