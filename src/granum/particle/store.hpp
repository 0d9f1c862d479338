// The granules of a rank: a structure of arrays whose columns know their name and what is to be done with them.
//
// A row is a parcel: `count` equal real granules of diameter `diameter`, which touch others as one sphere of `radius`.
// Row order is memory order and changes when granules are sorted; `id` is identity. Rows [0, owned) belong to this
// rank, the rows behind them are ghosts: copies of granules that a neighbour owns (or periodic images).
//
// Motion and contacts need the core columns only. The others come in groups that a run has or does not have, so that a
// run of granules alone does not carry what only gas and spray use.
#pragma once

#include "granum/base/error.hpp"
#include "granum/math/vec3.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace granum::particle
{
using Id = std::uint64_t;
using math::Vec3;

//! What a column is there for.
enum class Group : std::uint8_t
{
    core,        //!< motion and contacts: always there
    parcel,      //!< how many real granules of which size a row stands for; absent: one, as large as the row
    gas,         //!< what the gas does to the parcel
    process,     //!< heat, liquid and layers
    added_mass,  //!< gas that the parcel carries along (virtual mass)
    turning,     //!< what the gas does to the parcel's spin
    eddies,      //!< what the parcel sees of the gas's turbulence
    collisions,  //!< contacts that began
};

//! The groups of columns that a store has besides the core. The last four go with gas only.
struct Groups
{
    bool parcel = true, gas = true, process = true, added_mass = false, turning = false, eddies = false,
         collisions = false;

    bool has(Group group) const
    {
        switch (group) {
            case Group::parcel:
                return parcel;
            case Group::gas:
                return gas;
            case Group::process:
                return process;
            case Group::added_mass:
                return added_mass;
            case Group::turning:
                return turning;
            case Group::eddies:
                return eddies;
            case Group::collisions:
                return collisions;
            case Group::core:
                break;
        }
        return true;
    }
};

struct Traits
{
    std::string_view name, unit;
    bool halo = false;    //!< ghosts carry it
    bool output = false;  //!< written to the granule files
    Group group = Group::core;
};

template <class T>
struct Column
{
    Traits traits;
    std::vector<T> values{};

    T& operator[](std::size_t row)
    {
        expect(row);
        return values[row];
    }
    T const& operator[](std::size_t row) const
    {
        expect(row);
        return values[row];
    }

    // A column of a group that the store does not have is empty, so that reading one is seen here.
    void expect([[maybe_unused]] std::size_t row) const
    {
#ifdef GRANUM_CHECKS
        if (row >= values.size())
            throw base::NumericsError(fmt::format("column {} of the granules has {} rows: there is no row {}",
                                                  traits.name, values.size(), row));
#endif
    }
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

    Column<Vec3> force{{"force", "N"}};  //!< of contacts
    Column<Vec3> torque{{"torque", "N m"}};

    // What the gas does to the parcel during a coupling interval (set by `coupling`, read by `dem`).
    Column<Vec3> gas_velocity{{"gas_velocity", "m/s", false, false, Group::gas}};  //!< seen by the parcel
    //! Drag coefficient over mass and added mass: dv/dt = rate (u - v).
    Column<double> drag_rate{{"drag_rate", "1/s", false, false, Group::gas}};
    Column<Vec3> gas_force{{"gas_force", "N", false, false, Group::gas}};  //!< pressure gradient, lift and so on; held
    Column<Vec3> drag_impulse{{"drag_impulse", "N s", false, false, Group::gas}};      //!< summed by `dem` meanwhile
    Column<double> added_mass{{"added_mass", "kg", false, false, Group::added_mass}};  //!< accelerated with the parcel
    Column<Vec3> gas_spin{{"gas_spin", "rad/s", false, false, Group::turning}};        //!< half the gas's vorticity
    //! Rotational drag over the moment of inertia: dw/dt = rate (gas_spin - w).
    Column<double> spin_rate{{"spin_rate", "1/s", false, false, Group::turning}};
    Column<Vec3> spin_impulse{{"spin_impulse", "N m s", false, false, Group::turning}};  //!< summed by `dem` meanwhile

    //! Fluctuation of the gas that the parcel sees, over its standard deviation.
    Column<Vec3> fluctuation{{"fluctuation", "1", false, false, Group::eddies}};
    Column<double> eddy_left{{"eddy_left", "s", false, false, Group::eddies}};  //!< time that the present eddy lives on

    // The real granules that the parcel stands for.
    Column<double> count{{"count", "1", true, true, Group::parcel}};
    Column<double> diameter{{"diameter", "m", true, true, Group::parcel}};  //!< of one real granule

    // What liquid and heat do to them.
    Column<double> core_mass{{"core_mass", "kg", false, false, Group::process}};         //!< of the parcel
    Column<double> core_diameter{{"core_diameter", "m", false, false, Group::process}};  //!< of one real granule
    Column<double> layer_mass{{"layer_mass", "kg", false, true, Group::process}};        //!< dried solids of the parcel
    Column<double> layer_volume{{"layer_volume", "m3", false, false, Group::process}};   //!< dried layer with its pores
    Column<double> water{{"water", "kg", false, true, Group::process}};             //!< in open deposits and absorbed
    Column<double> absorbed{{"absorbed", "kg", false, false, Group::process}};      //!< of that water, within the core
    Column<double> solute{{"solute", "kg", false, true, Group::process}};           //!< solids in open deposits
    Column<double> enthalpy{{"enthalpy", "J", false, false, Group::process}};       //!< stored; zero at 0 degC, liquid
    Column<double> temperature{{"temperature", "K", false, true, Group::process}};  //!< follows from the enthalpy

    // Collisions that began, with granules and with walls, which whoever reads them sets back to zero: their number,
    // the changes of velocity, what they dissipated (see dem).
    Column<double> collisions{{"collisions", "1", false, false, Group::collisions}};
    Column<double> collision_speed{{"collision_speed", "m/s", false, false, Group::collisions}};
    Column<double> collision_wear{{"collision_wear", "J/kg", false, false, Group::collisions}};
    Column<double> wall_collisions{{"wall_collisions", "1", false, false, Group::collisions}};
    Column<double> wall_collision_speed{{"wall_collision_speed", "m/s", false, false, Group::collisions}};
    Column<double> wall_collision_wear{{"wall_collision_wear", "J/kg", false, false, Group::collisions}};

    Groups groups{};  //!< changed by `keep` only
    std::size_t owned = 0;

    std::size_t rows() const { return id.values.size(); }
    std::size_t ghosts() const { return rows() - owned; }
    void resize(std::size_t rows);
    //! Frees the columns of the groups not wanted; rows of columns that become present hold zeros.
    void keep(Groups const& wanted);

    //! @{ What a row stands for, also where the store has no column for it.
    double real_count(std::size_t row) const { return groups.parcel ? count[row] : 1; }
    double real_diameter(std::size_t row) const { return groups.parcel ? diameter[row] : 2 * radius[row]; }
    //! @}
};

//! Calls visit(column) for every column of the store, absent ones included, in a fixed order.
template <class StoreType, class Visitor>
void for_every_column(StoreType& store, Visitor&& visit)
{
    visit(store.id), visit(store.position), visit(store.velocity), visit(store.spin);
    visit(store.radius), visit(store.mass), visit(store.material);
    visit(store.force), visit(store.torque);
    visit(store.gas_velocity), visit(store.drag_rate), visit(store.gas_force), visit(store.drag_impulse);
    visit(store.added_mass), visit(store.gas_spin), visit(store.spin_rate), visit(store.spin_impulse);
    visit(store.fluctuation), visit(store.eddy_left);
    visit(store.count), visit(store.diameter), visit(store.core_mass), visit(store.core_diameter),
        visit(store.layer_mass);
    visit(store.layer_volume), visit(store.water), visit(store.absorbed), visit(store.solute), visit(store.enthalpy);
    visit(store.temperature), visit(store.collisions), visit(store.collision_speed), visit(store.collision_wear);
    visit(store.wall_collisions), visit(store.wall_collision_speed), visit(store.wall_collision_wear);
}

//! Calls visit(column) for every column that the store has, in a fixed order.
template <class StoreType, class Visitor>
void for_each_column(StoreType& store, Visitor&& visit)
{
    for_every_column(store, [&](auto& column) {
        if (store.groups.has(column.traits.group)) visit(column);
    });
}

inline void Store::keep(Groups const& wanted)
{
    groups = wanted;
    for_every_column(*this, [this](auto& column) {
        if (groups.has(column.traits.group))
            column.values.resize(rows());
        else
            std::exchange(column.values, {});
    });
}

inline void Store::resize(std::size_t rows)
{
    for_each_column(*this, [rows](auto& column) { column.values.resize(rows); });
    if (owned > rows) owned = rows;
}
}
