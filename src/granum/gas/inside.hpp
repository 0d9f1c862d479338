// What the parts of the gas step share: the open geometry of faces, walls, scratch fields. Private to the room.
//
// Nodes are cells (for what they hold) or the faces of one direction (for a velocity component). A link lies between a
// node and the next one below it in a direction, and stands at the index of the upper one.
#pragma once

#include "granum/gas/closure.hpp"
#include "granum/gas/flow.hpp"
#include "granum/gas/limit.hpp"
#include "granum/grid/halo.hpp"
#include "granum/solve/pressure.hpp"

#include <array>
#include <vector>

namespace granum::gas
{
using grid::Index;
using grid::Run;

//! An open face at an end of the domain.
struct OpenFace
{
    Index face, inside;  //!< inside: the cell that it belongs to
    std::size_t d;
    bool upper;
    std::size_t number;  //!< of the inlet or outlet
    double area;         //!< m2
    double half;         //!< from the cell's centre, m
    double share;        //!< of an inlet: of its flow
};

//! Where gas of an inlet flows along a face of another direction: what enters there has no velocity along it.
struct InletEdge
{
    Index face;           //!< of direction d (by which they are sorted)
    std::size_t e;        //!< direction of the inlet
    Index first, second;  //!< faces of direction e
    double sign;          //!< of what enters
};

//! A piece of wall in a cell, with its normal along e.
struct WallPiece
{
    Index cell;
    std::size_t e;
    std::size_t wall;  //!< of Settings::walls
    bool upper;        //!< whether the gas lies below it
    double area;       //!< m2
    double distance;   //!< of the cell's gas from it, m
    Vec3 position;     //!< m
};

//! The equation of an outlet's face, which has one neighbour: the face before it.
struct EndRow
{
    Index face, inner;
    double mobility, coupling, convected, right;  //!< convected: part of the coupling that convection makes
};

//! The linear system of one set of nodes: centre x = right + sum of coupling times x of the neighbours.
struct Rows
{
    Field inverse, right;           //!< 1 / centre; right side without neighbours
    std::array<Field, 6> coupling;  //!< lower and upper neighbour by direction
    std::vector<EndRow> ends;
    Field partial;  //!< scratch of a sweep
    explicit Rows(grid::Grid const& grid);
};

//! What passes links: flux from the lower node to the upper, 1 where there is a link, weight of the lower node.
struct Links
{
    std::array<Field const*, 3> flux, coupled, share;
};

//! Sources with ghosts filled.
struct SharedSources
{
    Field drag_coefficient, mass;
    std::array<Field, 3> drag_momentum, force;  //!< N
};

//! A conserved scalar for one step: content' = content + dt (source - sink x - div(flux x - conductance grad x)).
struct Carried
{
    Field content;          //!< before, and after the step
    Field capacity;         //!< at the end of the step: content' = capacity x
    FaceField flux;         //!< capacity per s through lower faces
    FaceField conductance;  //!< per s and unit of x
    Field source, sink;
    std::vector<double> at_inlets, at_outlets;  //!< x of what enters there
    bool entering_bounds = true;                //!< what enters is no new extreme for the cell behind it
    FaceField passed;                           //!< result: total flux through lower faces
};

//! Heat that a wall takes from a cell: conductance (T - outside), in degC.
struct WallExchange
{
    Index cell;
    double conductance, outside;  //!< W/K, degC
};

struct Solver::Inside
{
    Inside(Settings given, grid::Grid const& cells, par::Communicator const& ranks);

    Settings settings;
    grid::Grid const& grid;
    par::Communicator const& comm;

    FaceField area;                           //!< open to the gas, m2: ends without inlet or outlet are closed
    FaceField face_volume;                    //!< of the momentum control volumes, m3; 1 where nothing is solved for
    FaceField solved;                         //!< 1 for faces between two open cells
    FaceField bounding;                       //!< 1 for these and for inlets: what both sides bound a scalar
    FaceField per_gap;                        //!< 1 over the distance of the cells' centres, 1/m
    FaceField low_share;                      //!< weight of the lower cell in the value at a face
    std::array<FaceField, 3> coupled, reach;  //!< of links: 1 where both faces are there; viscous area over distance, m
    FaceWeights weights;
    std::array<std::vector<Run>, 3> faces;  //!< owned faces solved for
    std::vector<Run> cells;                 //!< owned open cells
    std::vector<OpenFace> inlets, outlets;  //!< of this rank
    std::array<std::vector<InletEdge>, 3> inlet_edges;
    std::vector<WallPiece> wall_pieces;  //!< those of a cell one behind the other
    std::vector<bool> wall_oblique;      //!< whether the pieces of the cell are projections of one wall
    std::vector<WallExchange> wall_exchange;
    std::vector<double> inlet_areas, outlet_areas;  //!< of all ranks, m2

    solve::Pressure pressure;
    solve::System system;
    Field correction;          //!< of pressure, Pa; the next step's first guess
    Field exchanged;           //!< K
    double static_before = 0;  //!< State::static_pressure at the beginning of the step

    FaceField mobility;  //!< m_f/dt + K_f + friction, kg/s
    FaceField stress;    //!< force of the viscous stress on the faces' volumes per volume, N/m3
    Field inertia;       //!< mass of the cells in the middle of the step, kg
    bool stepped = false;
    Field gas_volume;  //!< eps V, m3
    //! What the equation of state takes: as of the beginning of the step, or what came of its last trial.
    Field expected_temperature, expected_vapour, expected_tracer;
    Field viscous;                           //!< viscosity of the cells, Pa s
    FaceField middle_flux;                   //!< mass flux in the middle of the step, kg/s
    std::array<Field, 3> friction, dragged;  //!< of walls in a cell on a component, kg/s; times the walls' velocity, N
    FaceField begun;                         //!< velocities at the beginning of the step
    int sweeps = 0;                          //!< done in this step
    Rows rows, halves;                       //!< of the step; of the correction of convection
    Field change, half;                      //!< the correction; 1/2 everywhere
    FaceField link_flux;                     //!< mass flux through the links of one velocity component, kg/s
    Limit limit;
    Carried carried;
    std::unique_ptr<Closure> closure;  //!< none where the gas is laminar and Newtonian

    Index next(Index at, std::size_t d) const { return grid.next(at, d); }
    Index before(Index at, std::size_t d) const { return grid.before(at, d); }
    void refresh(std::initializer_list<Field*> fields) const { grid::refresh(grid, fields); }
    //! One cell that is its own neighbour: nothing passes between it and itself.
    bool repeats_itself(std::size_t d) const { return grid.periodic[d] && grid.global[d] == 1; }

    double viscosity(double temperature) const;
    double equation_of_state(double at_pressure, double temperature, double vapour, double tracer) const;

    void find_openings();
    void find_faces();
    void find_walls();

    SharedSources share(Sources const& sources) const;
    std::array<Field, 3> mean_velocity(State const& state) const;  //!< of the cells, ghosts filled. Collective.
    //! `mean`: cell_velocity of the state. Without ghosts.
    Gradient velocity_gradient(State const& state, std::array<Field, 3> const& mean) const;
    //! Adds the force on the gas of owned cells, N, that torques make.
    void add_couples(std::array<Field, 3> const& couple, std::array<Field, 3>& force) const;
    void set_inlet_velocities(State& state) const;
    //! Takes the velocities on; they are not yet free of sources of mass.
    void predict(State& state, SharedSources const& sources, double dt);
    void predict_component(std::size_t d, State& state, SharedSources const& sources, double dt);
    void make_end_rows(std::size_t d, State const& state, double dt);
    //! Fluxes of the end of the step, and the mass they leave.
    solve::Outcome project(State& state, SharedSources const& sources, double dt, Balance& balance);
    //! Gauss-Seidel sweeps over `rows`, forward and backward, until none changes x by more than `tolerance` of its
    //! largest value. Ghosts of x are filled. Collective.
    void sweep(Rows& system_of, std::vector<Run> const& nodes, Field& x, double tolerance, int most);
    //! Fills `limit.added` with what convection of second order adds to the upwind fluxes; `rows` hold the system whose
    //! solution x is. Ghosts of x and earlier are filled. Collective.
    void sharpen(std::vector<Run> const& nodes, Links const& links, Field const& x, Field const& earlier);
    //! Solves for x (that before the step in, that of the implicit upwind solution out, ghosts filled) and updates
    //! content, to which convection of second order may have added. Nothing leaves the range of x so far, which the
    //! upwind solution may have widened.
    void carry(Carried& what, Field& x, Range& range, double dt);
    //! Conductances of the links from a property per area and length.
    void conduct(Field const& property);
    //! Adds what passed openings in the last carry, times `worth`.
    void add_passed(double Balance::*in, double Balance::*out, double dt, double worth, Balance& to) const;
    void add_walls(State const& state, Carried& heat);
    void add_pressure_work(State const& state, double dt, Carried& heat) const;
    void carry_scalars(State& state, Sources const& sources, double dt, Balance& balance);
    //! @{ closure.cpp: from the state to `viscous` and what else the closure holds for a step. Collective.
    void make_closure();
    void close(State const& state);
    void close_at_walls(State const& state, std::array<Field, 3> const& mean);
    //! @}
    //! @{ eddies.cpp: what a two-equation model transports. Collective.
    void start_eddies(State& state) const;
    void carry_eddies(State& state, Sources const& sources, double dt);
    void add_granules(State const& state, Sources const& sources, double dt);
    double inlet_energy(State const& state, std::size_t number) const;
    double inlet_length(std::size_t number) const;
    //! @}
    double slope_of(Field const& x, std::size_t e, Index c, double width) const;
    void add_eddies(Field& property, double per) const;  //!< voidage times eddy viscosity over `per`, Pa s
    Field wall_distance() const;  //!< m, of the cells' centres from walls that hold the gas; ghosts filled. Collective.
    void derive(State& state) const;
    //! How far the mass of a cell is off that of its equation of state, the largest share. Collective.
    double off_state(State const& state) const;
    void check(State const& state) const;
    void check(Sources const& sources) const;
};
}
