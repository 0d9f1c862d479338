// Text for the page: escaping and numbers as engineers write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace granum::report
{
inline constexpr char const* not_available = "not available";

//! `text` so that a browser shows it letter by letter, in an element or a quoted attribute.
std::string escape(std::string_view text);

//! A number with `digits` significant digits: 0.7175, 65.6, 12 400, 1.3e-12. "not available" where it is not finite.
std::string number(double value, int digits = 4);

//! A count: 9999, 12 400, 6 120 000.
std::string whole(double value);

//! A number and its unit, or "not available".
std::string quantity(std::optional<double> value, std::string const& unit, int digits = 4);

//! Seconds as a person says it: 42 s, 3 min 12 s, 1 h 5 min.
std::string duration(double seconds);
}
