// The granules of a rank: a structure of arrays whose columns know their name and what is to be done with them.
//
// A row is a parcel: `count` equal real granules of diameter `diameter`, which touch others as one sphere of `radius`.
// Row order is memory order and changes when granules are sorted; `id` is identity. Rows [0, owned) belong to this
// rank, the rows behind them are ghosts: copies of granules that a neighbour owns (or periodic images).
#pragma once

#include "granum/math/vec3.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace granum::particle
{
using Id = std::uint64_t;
using math::Vec3;

struct Traits
{
    std::string_view name, unit;
    bool halo = false;    //!< ghosts carry it
    bool output = false;  //!< written to the granule files
};

template <class T>
struct Column
{
    Traits traits;
    std::vector<T> values{};

    T& operator[](std::size_t row) { return values[row]; }
    T const& operator[](std::size_t row) const { return values[row]; }
};

struct Store
{
    Column<Id> id{{"id", "1", true, true}};
    Column<Vec3> position{{"position", "m", true, false}};
    Column<Vec3> velocity{{"velocity", "m/s", true, true}};
    Column<Vec3> spin{{"spin", "rad/s", true, true}};
    Column<double> radius{{"radius", "m", true, true}};  //!< of the parcel in contacts
    Column<double> mass{{"mass", "kg", true, true}};     //!< of the parcel: core, layer and liquid
    Column<std::uint32_t> material{{"material", "1", true, true}};

    Column<Vec3> force{{"force", "N"}};  //!< contacts and gravity, not the gas
    Column<Vec3> torque{{"torque", "N m"}};

    // What the gas does to the parcel during a coupling interval (set by `coupling`, read by `dem`).
    Column<Vec3> gas_velocity{{"gas_velocity", "m/s"}};  //!< seen by the parcel
    Column<double> drag_rate{{"drag_rate", "1/s"}};      //!< drag coefficient over mass: dv/dt = rate (u - v)
    Column<Vec3> gas_force{{"gas_force", "N"}};          //!< pressure gradient and viscous force, held constant
    Column<Vec3> drag_impulse{{"drag_impulse", "N s"}};  //!< summed by `dem` over the interval

    // The real granules that the parcel stands for.
    Column<double> count{{"count", "1", true, true}};
    Column<double> diameter{{"diameter", "m", true, true}};         //!< of one real granule
    Column<double> core_mass{{"core_mass", "kg"}};                  //!< of the parcel
    Column<double> core_diameter{{"core_diameter", "m"}};           //!< of one real granule
    Column<double> layer_mass{{"layer_mass", "kg", false, true}};   //!< dried solids of the parcel
    Column<double> layer_volume{{"layer_volume", "m3"}};            //!< of the dried layer with its pores
    Column<double> water{{"water", "kg", false, true}};             //!< in open deposits of the parcel
    Column<double> solute{{"solute", "kg", false, true}};           //!< solids in open deposits
    Column<double> enthalpy{{"enthalpy", "J"}};                     //!< stored state; zero at 0 degC, liquid water
    Column<double> temperature{{"temperature", "K", false, true}};  //!< follows from the enthalpy

    std::size_t owned = 0;

    std::size_t rows() const { return id.values.size(); }
    std::size_t ghosts() const { return rows() - owned; }
    void resize(std::size_t rows);
};

//! Calls visit(column) for every column of the store, in a fixed order.
template <class StoreType, class Visitor>
void for_each_column(StoreType& store, Visitor&& visit)
{
    visit(store.id), visit(store.position), visit(store.velocity), visit(store.spin);
    visit(store.radius), visit(store.mass), visit(store.material);
    visit(store.force), visit(store.torque);
    visit(store.gas_velocity), visit(store.drag_rate), visit(store.gas_force), visit(store.drag_impulse);
    visit(store.count), visit(store.diameter), visit(store.core_mass), visit(store.core_diameter),
        visit(store.layer_mass);
    visit(store.layer_volume), visit(store.water), visit(store.solute), visit(store.enthalpy);
    visit(store.temperature);
}

inline void Store::resize(std::size_t rows)
{
    for_each_column(*this, [rows](auto& column) { column.values.resize(rows); });
    if (owned > rows) owned = rows;
}
}
