#include "granum/io/units.hpp"

#include "granum/base/error.hpp"
#include "granum/base/type_list.hpp"
#include "granum/io/data_folder.hpp"

#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <vector>

namespace granum::io
{
namespace
{
struct Row
{
    Dimension dimension;
    std::string_view name, si, example, shown;
};

//! One row per dimension, in the order of the enum. `shown` is the unit of write_quantity.
constexpr std::array rows{
    Row{Dimension::one, "a pure number", "1", "30 %", "1"},
    Row{Dimension::length, "a length", "m", "0.6 mm", "mm"},
    Row{Dimension::mass, "a mass", "kg", "1 kg", "kg"},
    Row{Dimension::time, "a time", "s", "3 s", "s"},
    Row{Dimension::temperature, "a temperature", "K", "80 degC", "degC"},
    Row{Dimension::temperature_difference, "a temperature difference", "K", "10 K", "K"},
    Row{Dimension::angle, "an angle", "rad", "15 deg", "deg"},
    Row{Dimension::angular_speed, "an angular speed", "rad/s", "60 rpm", "rad/s"},
    Row{Dimension::velocity, "a velocity", "m/s", "1.3 m/s", "m/s"},
    Row{Dimension::acceleration, "an acceleration", "m/s2", "9.81 m/s2", "m/s2"},
    Row{Dimension::area, "an area", "m2", "0.025 m2", "m2"},
    Row{Dimension::volume, "a volume", "m3", "1 L", "L"},
    Row{Dimension::density, "a density", "kg/m3", "1445 kg/m3", "kg/m3"},
    Row{Dimension::pressure, "a pressure", "Pa", "1 bar", "Pa"},
    Row{Dimension::mass_flow, "a mass flow", "kg/s", "1.2 kg/h", "kg/h"},
    Row{Dimension::volume_flow, "a volume flow", "m3/s", "120 m3/h", "m3/h"},
    Row{Dimension::viscosity, "a viscosity", "Pa.s", "3 mPa s", "mPa.s"},
    Row{Dimension::surface_tension, "a surface tension", "N/m", "63 mN/m", "mN/m"},
    Row{Dimension::stiffness, "a stiffness", "N/m", "1000 N/m", "N/m"},
    Row{Dimension::heat_capacity, "a heat capacity", "J/kg/K", "1400 J/kg/K", "J/kg/K"},
    Row{Dimension::specific_energy, "a heat per mass", "J/kg", "224 kJ/kg", "J/kg"},
    Row{Dimension::mass_per_energy, "a mass per work", "kg/J", "1e-6 kg/J", "kg/J"},
    Row{Dimension::conductivity, "a thermal conductivity", "W/m/K", "0.026 W/m/K", "W/m/K"},
    Row{Dimension::molar_mass, "a molar mass", "kg/mol", "144.1 g/mol", "g/mol"},
    Row{Dimension::power, "a power", "W", "100 W", "W"},
    Row{Dimension::energy, "an energy", "J", "1 J", "J"},
    Row{Dimension::force, "a force", "N", "1 N", "N"},
    Row{Dimension::count_rate, "a rate", "1/s", "20000 1/s", "1/s"},
    Row{Dimension::count_flux, "a number per area and time", "1/m2/s", "1e20 1/m2/s", "1/m2/s"},
    Row{Dimension::diffusivity, "a diffusivity", "m2/s", "2.5e-5 m2/s", "m2/s"},
    Row{Dimension::expansion, "a thermal expansion", "1/K", "0.0034 1/K", "1/K"},
    Row{Dimension::heat_transfer, "a heat transfer coefficient", "W/m2/K", "5 W/m2/K", "W/m2/K"},
    Row{Dimension::pressure_gradient, "a pressure gradient", "Pa/m", "100 Pa/m", "Pa/m"},
    Row{Dimension::flow_resistance, "a resistance of flow", "Pa.s/m", "30 Pa.s/m", "Pa.s/m"},
};

Row const& row_of(Dimension dimension)
{
    return rows[static_cast<std::size_t>(dimension)];
}

constexpr std::array symbols{"m",   "kg",  "g",    "t",    "s",   "min", "h",   "d",   "K",   "degC", "N",  "Pa",
                             "kPa", "bar", "mbar", "barg", "atm", "J",   "kJ",  "W",   "kW",  "P",    "cP", "L",
                             "mL",  "deg", "rad",  "rpm",  "rev", "%",   "ppm", "Hz",  "mol", "mm",   "um", "cm",
                             "nm",  "mg",  "ug",   "ms",   "us",  "mN",  "mPa", "MPa", "GPa", "mJ",   "uJ", "mmWC"};

struct FreeUnit
{
    void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

ut_system* unit_system()
{
    static ut_system* const system = [] {
        ut_set_error_message_handler(ut_ignore);
        auto const path = data_folder() + "/units/granum-units.xml";
        auto* const read = ut_read_xml(path.c_str());
        if (!read) throw base::IoError(fmt::format("{}: cannot be read as a file of units", path));
        return read;
    }();
    return system;
}

Unit parse(std::string const& text)
{
    return Unit(ut_parse(unit_system(), text.c_str(), UT_ASCII));
}

//! Signs that keyboards offer, in the letters that the unit parser knows.
std::string plain(std::string_view unit)
{
    std::string out(unit);
    constexpr std::array<std::array<std::string_view, 2>, 9> spellings{{{"°C", "degC"},
                                                                        {"°", "deg"},
                                                                        {"µ", "u"},
                                                                        {"μ", "u"},
                                                                        {"²", "2"},
                                                                        {"³", "3"},
                                                                        {"·", "."},
                                                                        {"wt%", "%"},
                                                                        {"wt.%", "%"}}};
    for (auto const& [from, to] : spellings)
        for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size())
            out.replace(at, from.size(), to);
    return out;
}

[[noreturn]] void unknown_unit(std::string const& unit)
{
    std::string word;
    for (std::size_t i = 0; i <= unit.size(); ++i) {
        bool const letter = i < unit.size() && (std::isalpha(static_cast<unsigned char>(unit[i])) || unit[i] == '%');
        if (letter) {
            word += unit[i];
            continue;
        }
        if (!word.empty() && !parse(word)) break;
        word.clear();
    }
    if (word.empty()) throw QuantityError(fmt::format("has the unit \"{}\", which cannot be read", unit), "");
    std::vector<std::string> const known(symbols.begin(), symbols.end());
    std::string near = base::nearest_name(word, known);
    if (word == "C" || word == "\u00b0C" || word == "\u2103") near = "degC";  // as people write them
    if (word == "F" || word == "\u00b0F") near = "degF";
    for (auto const& symbol : known)  // case is the commonest slip: "KG", "Mm"
        if (symbol.size() == word.size() && std::equal(word.begin(), word.end(), symbol.begin(), [](char a, char b) {
                return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
            }))
            near = symbol;
    throw QuantityError(fmt::format("has the unknown unit \"{}\"", word),
                        near.empty() ? "known units: m kg g s min h K degC Pa bar N J W L deg rad rpm %, with prefixes"
                                     : fmt::format("did you mean \"{}\"?", near));
}

std::string got(ut_unit* unit, std::string const& text)
{
    for (auto const& row : rows)
        if (ut_are_convertible(unit, parse(std::string(row.si)).get())) return fmt::format("{} ({})", row.name, text);
    return text;
}

double convert(double value, ut_unit* from, ut_unit* to)
{
    std::unique_ptr<cv_converter, void (*)(cv_converter*)> const converter(ut_get_converter(from, to), cv_free);
    return cv_convert_double(converter.get(), value);
}
}

std::string_view name_of(Dimension dimension)
{
    return row_of(dimension).name;
}
std::string_view example_of(Dimension dimension)
{
    return row_of(dimension).example;
}

double read_quantity(std::string_view text, Dimension dimension)
{
    Row const& row = row_of(dimension);
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    std::string_view digits = text;
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    double value = 0;
    auto const [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (fault != std::errc{} || !std::isfinite(value))
        throw QuantityError("does not begin with a number",
                            fmt::format("write {} such as \"{}\"", row.name, row.example));
    std::string_view rest(end, static_cast<std::size_t>(digits.data() + digits.size() - end));
    if (rest.size() > 1 && rest[0] == ',' && std::isdigit(static_cast<unsigned char>(rest[1]))) {
        std::string point(text);
        point[point.find(',')] = '.';
        throw QuantityError("has a decimal comma", fmt::format("write \"{}\"", point));
    }
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    if (rest.empty()) {
        if (dimension == Dimension::one) return value;
        throw QuantityError("needs a unit", fmt::format("expects {}, e.g. \"{}\"", row.name, row.example));
    }
    auto const unit_text = plain(rest);
    Unit const unit = parse(unit_text);
    if (!unit) unknown_unit(unit_text);
    Unit const si = parse(std::string(row.si));
    if (!ut_are_convertible(unit.get(), si.get()))
        throw QuantityError(fmt::format("expects {}, got {}", row.name, got(unit.get(), std::string(rest))),
                            fmt::format("write it like \"{}\"", row.example));
    // A difference of temperatures has no zero point, so units with one would be misread by 273 K.
    if (dimension == Dimension::temperature_difference && convert(0, unit.get(), si.get()) != 0)
        throw QuantityError("is a temperature difference and needs the unit K", fmt::format("write \"{} K\"", value));
    return convert(value, unit.get(), si.get());
}

std::string write_quantity(double value, Dimension dimension)
{
    Row const& row = row_of(dimension);
    if (!std::isfinite(value)) return "none";
    if (dimension == Dimension::one) return fmt::format("{:.6g}", value);
    Unit const si = parse(std::string(row.si)), shown = parse(std::string(row.shown));
    return fmt::format("{:.6g} {}", convert(value, si.get(), shown.get()), row.shown);
}
}
