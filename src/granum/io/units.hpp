// Quantities as people type them: "0.6 mm", "120 m3/h", "80 degC", "8 g/kg".
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace granum::io
{
//! What a value measures. Values are SI inside; a temperature is absolute, a temperature_difference is not.
enum class Dimension
{
    one,  //!< a pure number or fraction: a bare number is allowed
    length,
    mass,
    time,
    temperature,
    temperature_difference,
    angle,
    angular_speed,
    velocity,
    acceleration,
    area,
    volume,
    density,
    pressure,
    mass_flow,
    volume_flow,
    viscosity,
    surface_tension,
    stiffness,
    heat_capacity,
    specific_energy,
    mass_per_energy,
    conductivity,
    molar_mass,
    power,
    energy,
    force,
    count_rate,
    count_flux,
    diffusivity,
    expansion,
    heat_transfer,
    pressure_gradient,
    flow_resistance,
};

//! A text that is not a quantity of the dimension; `hint` may be empty.
struct QuantityError : std::runtime_error
{
    std::string hint;
    QuantityError(std::string const& what, std::string help) : std::runtime_error(what), hint(std::move(help)) {}
};

//! The value of `text` in SI. Throws QuantityError with a message that continues "key = value ...".
double read_quantity(std::string_view text, Dimension dimension);

//! `value` (SI) with the unit that people use for the dimension: 353.15 K -> "80 degC".
std::string write_quantity(double value, Dimension dimension);

//! "a length" and "0.6 mm".
std::string_view name_of(Dimension dimension);
std::string_view example_of(Dimension dimension);
}
