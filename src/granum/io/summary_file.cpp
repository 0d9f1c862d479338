#include "granum/io/summary_file.hpp"

#include "granum/base/error.hpp"
#include "granum/io/text_file.hpp"

#include <filesystem>

namespace granum::io
{
nlohmann::json read_summary(std::string const& folder)
{
    auto const path = (std::filesystem::path(folder) / "summary.json").string();
    auto out = nlohmann::json::parse(read_text(path), nullptr, false);
    if (out.is_discarded()) throw base::IoError(path + ": is not JSON");
    return out;
}

nlohmann::json const& at(nlohmann::json const& summary, std::string_view key)
{
    static nlohmann::json const nothing;
    nlohmann::json const* here = &summary;
    while (true) {
        auto const dot = key.find('.');
        std::string const name(key.substr(0, dot));
        if (!here->is_object() || !here->contains(name)) return nothing;
        here = &(*here)[name];
        if (dot == std::string_view::npos) return *here;
        key.remove_prefix(dot + 1);
    }
}

std::optional<double> number_at(nlohmann::json const& summary, std::string_view key)
{
    auto const& found = at(summary, key);
    if (!found.is_number()) return std::nullopt;
    return found.get<double>();
}
}
