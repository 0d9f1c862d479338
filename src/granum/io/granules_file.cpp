#include "granum/io/granules_file.hpp"

#include "granum/base/error.hpp"
#include "granum/base/type_list.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>
#include <unordered_map>

namespace granum::io
{
namespace
{
constexpr std::array names{"id", "x", "y", "z", "radius", "vx", "vy", "vz", "wx", "wy", "wz", "material"};
constexpr char const* columns = "columns: id,x,y,z,radius[,vx,vy,vz[,wx,wy,wz[,material]]] in m, m/s and rad/s";

[[noreturn]] void fail(std::string const& path, int line, std::string const& entry, std::string const& what,
                       std::vector<std::string> hints = {columns})
{
    throw base::CaseError({{path, line, entry, what, std::move(hints)}});
}

std::string_view trimmed(std::string_view text)
{
    auto const first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view line)
{
    std::vector<std::string_view> out;
    for (;;) {
        auto const comma = line.find(',');
        out.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return out;
        line.remove_prefix(comma + 1);
    }
}

// Which column each field is: from the first line where it holds names.
std::vector<std::size_t> named(std::vector<std::string_view> const& fields, std::string const& path, int line)
{
    std::vector<std::size_t> order;
    for (auto const field : fields) {
        auto const found = std::find(names.begin(), names.end(), field);
        if (found == names.end()) {
            std::vector<std::string> hints{columns};
            if (auto const near = base::nearest_name(field, {names.begin(), names.end()}); !near.empty())
                hints.push_back(fmt::format("did you mean \"{}\"?", near));
            fail(path, line, fmt::format("\"{}\"", field), "is not a column of a granule file", hints);
        }
        auto const at = static_cast<std::size_t>(found - names.begin());
        if (std::find(order.begin(), order.end(), at) != order.end())
            fail(path, line, fmt::format("\"{}\"", field), "is there twice");
        order.push_back(at);
    }
    for (std::size_t needed = 0; needed < 5; ++needed)
        if (std::find(order.begin(), order.end(), needed) == order.end())
            fail(path, line, "", fmt::format("there is no column {}", names[needed]));
    return order;
}

double number(std::string_view field, char const* name, std::string const& path, int line)
{
    double value = 0;
    auto const [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (failure != std::errc{} || end != field.data() + field.size() || !std::isfinite(value))
        fail(path, line, fmt::format("{} = {}", name, field), "is not a finite number");
    return value;
}
}

std::vector<GranuleRecord> read_granules(std::string const& path)
{
    std::ifstream in(path, std::ios::binary);
    if (!in) fail(path, 0, "", "cannot be opened", {"the path is relative to the case file"});
    std::vector<GranuleRecord> out;
    std::unordered_map<std::uint64_t, int> seen;
    std::vector<std::size_t> order;
    std::string text;
    for (int line = 1; std::getline(in, text); ++line) {
        auto const content = trimmed(text);
        if (content.empty() || content.front() == '#') continue;
        auto const fields = split(content);
        if (order.empty() && !fields[0].empty() &&
            ((fields[0].front() >= 'a' && fields[0].front() <= 'z') ||
             (fields[0].front() >= 'A' && fields[0].front() <= 'Z'))) {
            order = named(fields, path, line);
            continue;
        }
        if (order.empty()) {
            if (fields.size() != 5 && fields.size() != 8 && fields.size() != 11 && fields.size() != 12)
                fail(path, line, "", fmt::format("{} fields are not a granule", fields.size()));
            for (std::size_t k = 0; k < fields.size(); ++k) order.push_back(k);
        }
        if (fields.size() != order.size())
            fail(path, line, "", fmt::format("{} fields, but {} columns", fields.size(), order.size()));
        GranuleRecord one{.line = line};
        for (std::size_t k = 0; k < fields.size(); ++k) {
            auto const column = order[k];
            if (column == 11) {
                one.material = fields[k];
                continue;
            }
            double const value = number(fields[k], names[column], path, line);
            if (column == 0) {
                if (!(value >= 0 && value < static_cast<double>(largest_id) && value == std::floor(value)))
                    fail(path, line, fmt::format("id = {}", fields[k]), "is not an identity",
                         {fmt::format("allowed: whole numbers from 0 to {}", largest_id - 1)});
                one.id = static_cast<std::uint64_t>(value);
            } else if (column <= 3) {
                one.position[column - 1] = value;
            } else if (column == 4) {
                if (!(value > 0)) fail(path, line, fmt::format("radius = {}", fields[k]), "is not above 0");
                one.radius = value;
            } else {
                (column <= 7 ? one.velocity : one.spin)[(column - 5) % 3] = value;
            }
        }
        if (auto const [before, fresh] = seen.emplace(one.id, line); !fresh)
            fail(path, line, fmt::format("id = {}", one.id), fmt::format("is that of line {} too", before->second), {});
        out.push_back(std::move(one));
    }
    if (in.bad()) fail(path, 0, "", "cannot be read to its end", {});
    if (out.empty()) fail(path, 0, "", "holds no granules");
    return out;
}
}
