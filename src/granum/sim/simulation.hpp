// A simulation: the state of a case on this rank and the coupling step that moves it on.
//
// One step, in order: voidage, exchange coefficients, spray, drying (all with the gas at the beginning) feed the
// sources of one gas step; what the gas step gave goes to the granules; then granule steps with the gas held; then the
// audit.
#pragma once

#include "granum/coupling/conduction.hpp"
#include "granum/coupling/exchange.hpp"
#include "granum/dem/engine.hpp"
#include "granum/drying/drying.hpp"
#include "granum/gas/flow.hpp"
#include "granum/io/checkpoint.hpp"
#include "granum/material/wet_bulb_table.hpp"
#include "granum/sim/balance.hpp"
#include "granum/sim/case.hpp"
#include "granum/sim/hard_mover.hpp"
#include "granum/sim/ledger.hpp"
#include "granum/sim/programme.hpp"
#include "granum/sim/surroundings.hpp"
#include "granum/sim/traffic.hpp"
#include "granum/sim/wall_room.hpp"
#include "granum/spray/flight.hpp"
#include "granum/spray/nozzle.hpp"

#include <memory>
#include <optional>

namespace granum::sim
{
//! What passed since the start, over all ranks, in kg.
struct SprayTotals
{
    double solids = 0, water = 0;                    //!< left the nozzles
    double deposited = 0, walls = 0, overspray = 0;  //!< solids
    double in_flight = 0;                            //!< solids, now
    double evaporated = 0;                           //!< water, from droplets and deposits
    double deposited_water = 0;
    double splashed = 0;  //!< solids that flew on from a granule
    double abraded = 0;   //!< solids that collisions rubbed off layers, gone as dust
    long hits = 0;        //!< parcels that left a deposit
    long rebounds = 0;    //!< parcels, too dry to stick
};

//! Heat that passed since the start beside that between gas and granules, over all ranks, J.
struct HeatTotals
{
    double contacts = 0, film = 0;            //!< between granules, either way
    double wall_contacts = 0, wall_film = 0;  //!< from granules to walls, net
    double wall_gas = 0;                      //!< from the gas to walls, net
    double radiation = 0;                     //!< from granules to what is around them, which the gas bears, net
    double settling = 0;                      //!< to the bed from nowhere, while it settled, net
};

//! The outside of the process as it is now, over all ranks.
struct Readings
{
    double bed_temperature = 0;       //!< K, mean over granules by heat capacity
    double bed_moisture = 0;          //!< kg liquid water per kg dry bed
    double outlet_temperature = 0;    //!< K, of what left in the last step
    double outlet_humidity = 0;       //!< kg/kg dry
    double eta = 0;                   //!< global drying potential from the outlet's humidity
    double pressure_drop = 0;         //!< Pa, plate less outlet, hydrostatic part of the gas taken off
    double weight_over_area = 0;      //!< Pa, see summary
    double height = 0;                //!< m, of the bed: twice the mean height of its mass above the plate
    double highest = 0;               //!< m above the plate, of a granule's middle
    double coldest = 0, hottest = 0;  //!< K over gas and granules
    double water_on_granules = 0;     //!< kg
    double kinetic_energy = 0;        //!< J of the granules
};

//! What the gas of this rank took since the program began.
struct GasWork
{
    double cell_steps = 0;  //!< steps of its cells
    double bytes = 0;       //!< that they asked of memory, see gas/traffic.hpp
    double iterations = 0;  //!< of the pressure, times cells
    double sweeps = 0;      //!< times cells
};

//! The time in which the mean temperature of the bed goes to where the process holds it, see settling.cpp.
struct Settling
{
    double end = 0;               //!< s, when it ended; negative: it goes on
    bool enough = false;          //!< it ended because the bed had settled
    double since = 0, water = 0;  //!< s, and kg of water of the spray in flight and on granules then: the last look
};

struct WorkPoints;  // balance_work.cpp

class Simulation
{
  public:
    //! Builds the state at time zero or, where there is one, the state that `saved` holds (of the same case, written by
    //! any number of ranks). Collective. Throws as the rooms do.
    Simulation(Case data, par::Communicator const& comm, io::Checkpoint const* saved = nullptr);
    ~Simulation();

    //! One coupling step of at most `longest` seconds. Collective.
    void step(double longest);

    double time() const { return time_; }
    long steps() const { return steps_; }
    long granule_steps() const { return granule_steps_; }  //!< steps of all granules, summed
    double granule_dt() const { return granule_dt_; }
    Case const& data() const { return case_; }
    par::Communicator const& comm() const { return comm_; }
    particle::Store& granules() { return granules_; }
    dem::Engine& engine() { return *engine_; }  //!< of soft spheres
    Mover& mover() { return *mover_; }          //!< soft or hard
    bool has_gas() const { return solver_ != nullptr; }
    grid::Grid const& grid() const { return grid_; }
    gas::State const& gas() const { return gas_; }
    gas::Solver const& solver() const { return *solver_; }
    coupling::Exchange const& exchange() const { return *exchange_; }
    std::vector<spray::Droplet> const& droplets() const { return droplets_; }
    drying::Deposits const& deposits() const { return *deposits_; }
    Balance const& steady() const { return balance_; }
    Settling const& settling() const { return settling_; }
    Ledgers const& ledgers() const { return ledgers_; }
    SprayTotals totals() const;  //!< Collective.
    HeatTotals heat() const;     //!< Collective.
    Readings readings() const;   //!< Collective.
    Traffic const& traffic() const { return traffic_; }
    std::vector<Feed> const& feeds() const { return feeds_; }
    base::Stopwatch& stopwatch() { return stopwatch_; }
    double local_drying_potential(double temperature, double vapour_fraction) const;
    long unconverged_steps() const { return unconverged_; }  //!< gas steps whose pressure missed its tolerance
    GasWork const& gas_work() const { return gas_work_; }
    long clamped_cells() const { return exchange_ ? exchange_->clamped_cells() : 0; }

    //! All that the next step depends on, this rank's part: what a checkpoint holds.
    io::Sections save();

    //! The events since the last call, of all ranks, on rank 0 (empty elsewhere). Collective.
    std::vector<drying::Event> take_events();

  private:
    struct Saved;
    std::shared_ptr<Saved const> read(io::Checkpoint const& from) const;
    void take_granules(Saved const& saved);
    void take_contacts(Saved const& saved);
    void take_process(Saved const& saved);
    template <class Visit>
    void each_common_number(Visit&& visit);  //!< scalars of the state that are the same on every rank
    template <class Visit>
    void each_share(Visit&& visit);  //!< scalars of which every rank has its share

    //! Space among ranks, so that cells and granules at `places` (of which each rank names its share) will be as much
    //! work for each, in granule steps and in the gas step. Collective.
    par::Partition partition(std::vector<math::Vec3> const& places) const;
    void add_cells(WorkPoints& all) const;  //!< this rank's share of them
    void share_space(par::Partition partition);
    void balance_work(int substeps);     //!< cuts space anew where a rank has too much to do. Collective.
    void follow_programme(double time);  //!< sets inlets and spray to what they are then
    void move_gas();                     //!< to the ranks that have its cells now
    void find_nozzle_cells();
    void place_granules();
    void make_gas();
    void start_gas();
    void start_deposits();
    void hold_back(std::vector<GranuleCase>& list);  //!< moves what is fed out of the list
    void fill_feeds();                               //!< as they were before anything came in
    void settle_between_still_walls();
    void settle();
    //! Brings what is due into the region of a feed, the same on every rank, and tells whether anything came.
    bool feed(Feed& feed, double now);
    void feed_all(double now);  //!< Collective.
    void let_out();             //!< takes out, or refuses, what has left the domain. Collective.
    void take_collisions();
    void fly_droplets(double dt);
    //! Gives what does not stay on the granule; `stream` numbers the draws.
    std::optional<spray::Droplet> receive(spray::Hit const& hit, std::uint32_t stream);
    void exchange_droplets(std::vector<spray::Droplet> leaving);
    void nozzle_air(double dt);
    void gas_step(double dt);
    //! Heat capacity of the granules, J/K, and their mean temperature by it, K. Collective.
    std::array<double, 2> bed_temperature() const;
    void settle_bed(double before);  //!< `before`: mean temperature of the bed before the gas step. Collective.
    bool look_if_settled();          //!< whether the bed has; keeps what it saw for the next look. Collective.
    double liquid() const;           //!< kg of water in flight and in open deposits. Collective.
    void audit();
    std::array<double, 3> stocks() const;  //!< solids, water, energy of this rank

    Case case_;
    par::Communicator const& comm_;
    grid::Lines lines_;  //!< faces of all gas cells
    std::optional<par::Partition> partition_;
    grid::Grid grid_;
    particle::Store granules_;
    std::unique_ptr<dem::Engine> engine_;  //!< none where granules are hard
    std::unique_ptr<Mover> mover_;
    HardMover* hard_ = nullptr;  //!< `mover_` where granules are hard
    std::unique_ptr<gas::Solver> solver_;
    gas::State gas_;
    gas::Sources sources_;
    std::unique_ptr<coupling::Mapping> mapping_;
    std::unique_ptr<coupling::Histories> histories_;
    std::unique_ptr<coupling::Exchange> exchange_;
    std::unique_ptr<coupling::Conduction> conduction_;
    coupling::Seen seen_;
    std::vector<spray::Nozzle> nozzles_;
    std::vector<grid::Field> nozzle_weights_;  //!< share of each nozzle's air per cell
    std::unique_ptr<DropletSurroundings> around_;
    spray::FlightSettings flight_;
    std::vector<spray::Droplet> droplets_;
    std::unique_ptr<drying::Deposits> deposits_;
    std::unique_ptr<drying::Drying> drying_;
    std::unique_ptr<material::WetBulbTable> wet_bulb_;
    std::vector<double> potential_, evaporated_;
    std::vector<drying::Event> events_;
    Balance balance_;
    Nominal nominal_{case_};  //!< what the programme starts from
    Ledgers ledgers_;
    //! Sums since the start on this rank: solids, water, energy that came in and went out.
    std::array<double, 3> in_{}, out_{};
    SprayTotals mine_;
    HeatTotals heat_;
    Settling settling_;
    gas::Balance last_;  //!< boundary flows of the last gas step
    GasWork gas_work_;
    std::vector<Feed> feeds_;
    std::vector<GranuleCase> poured_;      //!< until they have been poured, before the run
    std::unique_ptr<WallRoom> wall_room_;  //!< for the feeds
    Traffic traffic_;
    double next_feed_ = 0;
    long feed_rounds_ = 0;  //!< so that every try draws anew
    base::Stopwatch stopwatch_;
    double time_ = 0, granule_dt_ = 0, largest_radius_ = 0;
    long steps_ = 0, granule_steps_ = 0, unconverged_ = 0;
};
}
