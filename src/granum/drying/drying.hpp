// Drying of the deposits on each granule (of a melt: solidification), their solids joining the layer, and the events
// that say how it went.
//
// Every cap on a granule has the granule's temperature. Its evaporation lies between that of an isolated cap and its
// share of the granule's boundary layer, as the chosen law combines them (physics.md 5.2); where they cover nearly all
// of the granule they dry as one film. A deposit is dry when its moisture has fallen to `end_moisture` of the feed's
// above that of equilibrium; the trace left above equilibrium then evaporates in the same step, the rest stays in the
// layer. A melt has its melting point until its heat of fusion has gone, through its surface and into its granule; all
// of it is put to the granule's account, which passes it on to the gas.
#pragma once

#include "granum/drying/deposits.hpp"
#include "granum/law/deposit/all.hpp"
#include "granum/law/deposit/rates.hpp"
#include "granum/law/deposit/solidification.hpp"
#include "granum/law/deposit/stages.hpp"
#include "granum/law/layer/abrasion.hpp"
#include "granum/law/vapour/sorption.hpp"
#include "granum/law/wetting/coalescence.hpp"
#include "granum/law/wetting/imbibition.hpp"
#include "granum/particle/store.hpp"

#include <functional>
#include <span>

namespace granum::drying
{
//! The liquid as it dries.
struct Liquid
{
    double density = 1000;         //!< of the feed, kg/m3
    double solids_density = 1440;  //!< without pores, kg/m3
    double solubility = 0;         //!< kg solids per kg water; 0: a suspension
    double molar_mass = 0.1;       //!< of the solute, kg/mol
    double dissociation = 1;
    double feed_moisture = 1;  //!< kg water per kg solids
    double melting_point = 0;  //!< K, of a melt; 0: no melt
    double conductivity = 0;   //!< of melt and granule, W/m/K
    bool melt() const { return melting_point > 0; }
};

struct Settings
{
    law::deposit::Any combine;
    Liquid liquid;
    law::deposit::AnyStages stages{};
    law::deposit::AnySolidification solidification{};
    law::deposit::AnyCrystallisation crystallisation{};
    law::wetting::Pores pores{};          //!< of the cores
    law::vapour::AnySorption sorption{};  //!< of the cores
    double viscosity = 1e-3;              //!< of the feed, Pa s
    double restitution = 0.8;             //!< of two dry granules
    double roughness = 1e-6;              //!< m, height of their asperities
    law::layer::AnyAbrasion abrasion{};   //!< of layers, see sim/collisions.cpp
    double sorption_time = 300;           //!< s in which the absorbed water comes to 1/e of its way to equilibrium
    double equilibrium_moisture = 0;      //!< kg/kg that stays in the layer
    double end_moisture = 0.01;           //!< of the feed's moisture, above that of equilibrium
    double film_coverage = 0.9;           //!< above it the deposits of a granule dry as one film
    double pressure = 101325;             //!< Pa
    //! Layer porosity of an element that met (mean local drying potential, drying time, moisture at impact).
    std::function<double(double, double, double)> porosity;
};

//! What the granules see, row by row, during the step.
struct Surroundings
{
    std::span<double const> temperature, vapour_fraction, drying_potential, slip, sherwood;
};

class Drying
{
  public:
    explicit Drying(Settings settings) : settings_(std::move(settings)) {}

    //! Evaporates for `dt` ending at time `now`. `evaporated` (kg per row) is overwritten; the granules' water, solute,
    //! layer and enthalpy change (vapour leaves with its enthalpy). Dried deposits are appended to `events`.
    void advance(particle::Store& granules, Deposits& deposits, Surroundings const& seen, double dt, double now,
                 std::vector<double>& evaporated, std::vector<Event>& events) const;

    //! Wet fraction of the surface of a real granule under these deposits, at most 1.
    static double coverage(std::vector<Deposit> const& deposits, double count, double diameter);

    //! The limits of one cap's evaporation, kg/s: alone on its granule, through the granule's boundary layer over its
    //! own surface, and over the whole granule. Flattened by what it has lost, with its own water activity and falling
    //! rate.
    struct Limits
    {
        double cap, layer;
        double film;  //!< if all of the granule were under it
    };
    Limits limits(Deposit const& deposit, law::deposit::Film film, double saturation, double sherwood, double diameter,
                  double relative_humidity, double gas_over_surface) const;
    //! kg of water, all caps together, at which a deposit of these kg of solids counts as dry.
    double dry_water(double solute) const
    {
        return (settings_.end_moisture * settings_.liquid.feed_moisture + settings_.equilibrium_moisture) * solute;
    }

    //! kg of water per kg of core in equilibrium with gas of this state around a granule of this temperature.
    double equilibrium(double granule_temperature, double gas_temperature, double vapour_fraction) const;

    Settings const& settings() const { return settings_; }

  private:
    //! What a step does to all caps of a deposit.
    struct Change
    {
        double lasts = 1;  //!< share of the step until the deposit is dry or solid; 1 if it is not
        double water = 0;  //!< kg that evaporate
        double heat = 0;   //!< J of fusion that the granule gets
        bool ends = false;
    };
    //! Of each deposit of a granule; kept from granule to granule so that nothing is allocated.
    struct Rates
    {
        std::vector<Limits> limit;
        std::vector<double> cap;  //!< kg/s of one cap; negative where it takes up water
    };
    void evaporation_rates(std::vector<Deposit> const& open, Surroundings const& seen, std::size_t row,
                           double temperature, double diameter, double count, Rates& rates) const;
    Change evaporate(Deposit const& deposit, double rate, double dt) const;
    Change solidify(Deposit const& deposit, double sherwood, double diameter, double gas, double granule,
                    double dt) const;
    //! @param mass of one real granule, kg
    //! @param layer mean thickness of what lies on it, m
    Event finish(Deposit const& deposit, double count, double diameter, double mass, double layer) const;

    Settings settings_;
};

//! Diameter of the real granules and radius, mass of the parcel after a change of core, layer or liquid.
void resize_granule(particle::Store& granules, std::size_t row);
}
