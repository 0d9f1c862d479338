#include "granum/map/trend.hpp"

#include "granum/base/error.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace granum::map
{
namespace
{
struct Published
{
    std::string_view property;
    int sign;
    std::string_view source;
};
constexpr std::array published{
    Published{"porosity", -1, "Rieck et al., Powder Technol. 272 (2015) 120"},
    Published{"roughness", -1, "Diez et al., Chem. Eng. Res. Des. 139 (2018) 104"},
    Published{"strength", 1, "Diez et al., Chem. Eng. Res. Des. 139 (2018) 104"},
};
}

int Trend::agrees() const
{
    if (published == 0 || std::abs(slope) < 2 * error) return 0;
    return slope * published > 0 ? 1 : -1;
}

std::string Trend::words() const
{
    std::string out = fmt::format("changes by {:+.3g} +- {:.1g} per drying potential", slope, error);
    if (published == 0) return out;
    char const* const verdict = agrees() > 0   ? ", as published"
                                : agrees() < 0 ? ", AGAINST what is published"
                                               : ", too uncertain to compare";
    return out + fmt::format("{} ({} with it: {})", verdict, published > 0 ? "rises" : "falls", source);
}

std::optional<Trend> trend(Map const& map)
{
    std::vector<Observed> observed;
    for (auto const& run : map.runs) observed.push_back({{.potential = run.potential}, run.value, run.error});
    LinearPotential line;
    try {
        line.fit(observed, map.known);
    } catch (base::NumericsError const&) {
        return std::nullopt;
    }
    Trend out{.slope = line.slope, .error = std::sqrt(line.covariance(1, 1))};
    for (auto const& one : published)
        if (map.property == one.property) out.published = one.sign, out.source = one.source;
    return out;
}
}
