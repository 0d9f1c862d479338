// What the parts of the gas step share: the open geometry of faces, the matrices, the scratch fields. Private to the
// room.
#pragma once

#include "granum/gas/flow.hpp"
#include "granum/solve/pressure.hpp"

#include <array>
#include <vector>

namespace granum::gas
{
using grid::Index;

//! A face whose velocity is solved for. `outlet`: the top of the domain, with the upper half cell missing.
struct FaceRow
{
    Index face;
    bool outlet;
    bool on_plate;  //!< its lowest edge lies on an open plate
};

//! One row of a seven-point system: centre x - sum of beside x_neighbour = right; `inverse` of centre for the sweeps.
//! Neighbours by direction: lower, upper.
struct Row
{
    double centre, inverse, right;
    std::array<double, 6> beside;
};

//! Sources with ghosts filled.
struct SharedSources
{
    Field drag_coefficient, mass;
    std::array<Field, 3> push;  //!< drag_momentum + force, N
};

//! A conserved scalar for one step: content' = content + dt (source - sink x - div(flux x - conductance grad x)).
struct Carried
{
    Field content;          //!< before, and after the step
    Field capacity;         //!< at the end of the step: content' = capacity x
    FaceField flux;         //!< capacity per s through lower faces
    FaceField conductance;  //!< per s and unit of x
    Field source, sink;
    double at_plate, at_top;  //!< x of what enters there
    FaceField passed;         //!< result: total flux through lower faces
};

struct Solver::Inside
{
    Inside(Settings given, grid::Grid const& cells, par::Communicator const& ranks);

    Settings settings;
    grid::Grid const& grid;
    par::Communicator const& comm;

    bool plate, top;        //!< gas enters at z = 0; leaves at the upper end
    double plate_area = 0;  //!< open, of all ranks, m2
    FaceField area;         //!< open to the gas, m2: ends without inlet or outlet are closed
    FaceField face_volume;  //!< of the momentum control volumes, m3
    FaceField shear;        //!< wall area over wall distance in the control volume, m
    FaceWeights weights;
    std::array<std::vector<FaceRow>, 3> faces;
    std::vector<Index> open_cells;  //!< owned, x fastest

    solve::Pressure pressure;
    solve::System system;
    Field correction;  //!< of pressure, Pa; the next step's first guess
    Field exchanged;   //!< K

    std::array<std::vector<Row>, 3> momentum_rows;
    std::vector<Row> cell_rows;
    FaceField mobility;  //!< m_f/dt + K_f, kg/s
    Carried carried;

    std::ptrdiff_t stride(std::size_t d) const { return grid.strides()[d]; }
    Index next(Index at, std::size_t d) const { return at + static_cast<Index>(grid.strides()[d]); }
    Index before(Index at, std::size_t d) const { return at - static_cast<Index>(grid.strides()[d]); }
    void refresh(std::initializer_list<Field*> fields) const;

    double viscosity(double temperature) const;
    double equation_of_state(double pressure, double temperature, double vapour_fraction) const;
    double inlet_flux(Index face) const;  //!< kg/s through a plate face

    //! Mass of the momentum control volume, kg.
    double face_mass(FaceRow const& row, std::size_t d, Field const& mass) const
    {
        return 0.5 * (mass[before(row.face, d)] + (row.outlet ? 0 : mass[row.face]));
    }
    //! Its gas volume eps V, m3.
    double face_gas_volume(FaceRow const& row, std::size_t d, Field const& voidage) const
    {
        Index const low = before(row.face, d);
        double const below = voidage[low] * grid.open_volume[low];
        return 0.5 * (below + (row.outlet ? 0 : voidage[row.face] * grid.open_volume[row.face]));
    }
    //! grad p at a face, Pa/m.
    double pressure_slope(FaceRow const& row, std::size_t d, Field const& p) const
    {
        double const low = p[before(row.face, d)];
        return row.outlet ? -low / (0.5 * grid.spacing[d]) : (p[row.face] - low) / grid.spacing[d];
    }
    //! Viscous conductance between a face and its neighbours, without voidage and viscosity, m.
    std::array<double, 6> viscous_reach(FaceRow const& row, std::size_t d) const;

    SharedSources share(Sources const& sources) const;
    void set_plate_velocity(State& state, Field const& voidage) const;
    void predict(State& state, SharedSources const& sources, Field const& voidage, double dt);
    //! Fluxes of the end of the step, and the mass they leave; returns iterations.
    solve::Outcome project(State& state, SharedSources const& sources, Field const& voidage, double dt);
    //! Solves for x (first guess in, solution out, ghosts filled) and updates content.
    void carry(Carried& what, Field& x, double dt);
    void carry_vapour_and_heat(State& state, Sources const& sources, double dt, Balance& balance);
    void derive(State& state) const;
    void check(State const& state) const;
    void check(Sources const& sources) const;
};
}
