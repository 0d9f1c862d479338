#include "granum/report/html.hpp"

#include <fmt/format.h>

#include <cmath>

namespace granum::report
{
std::string escape(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    for (char const letter : text) switch (letter) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += letter;
        }
    return out;
}

std::string number(double value, int digits)
{
    if (!std::isfinite(value)) return not_available;
    if (value == 0) return "0";
    double const size = std::abs(value);
    if (size < 1e-4 || size >= 1e9) return fmt::format("{:.{}e}", value, digits > 2 ? 1 : digits - 1);
    int const decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
    if (decimals == 0) return whole(value);
    return fmt::format("{:.{}f}", value, decimals);
}

std::string whole(double value)
{
    if (!std::isfinite(value)) return not_available;
    std::string out = fmt::format("{:.0f}", value);
    std::size_t const first = value < 0 ? 1 : 0;
    if (out.size() - first > 4)
        for (std::size_t at = out.size(); at > first + 3;) out.insert(at -= 3, "\u202f");  // narrow space
    return out;
}

std::string quantity(std::optional<double> value, std::string const& unit, int digits)
{
    if (!value || !std::isfinite(*value)) return not_available;
    std::string const out = number(*value, digits);
    return unit.empty() ? out : out + "\u00a0" + unit;
}

std::string duration(double seconds)
{
    if (!std::isfinite(seconds) || seconds < 0) return not_available;
    if (seconds < 100) return number(seconds, 3) + " s";
    auto const whole = static_cast<long>(std::lround(seconds));
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}
}
