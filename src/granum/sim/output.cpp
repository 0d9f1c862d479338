#include "granum/sim/output.hpp"

#include "granum/sim/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <tuple>

namespace granum::sim
{
namespace air = material;
using grid::Index;

namespace
{
//! Rows of any plain struct from all ranks, on rank 0.
template <class Row>
std::vector<Row> gathered(par::Communicator const& comm, std::vector<Row> const& mine)
{
    auto const bytes = comm.gather(std::as_bytes(std::span(mine)));
    std::vector<Row> all(bytes.size() / sizeof(Row));
    if (!bytes.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
    return all;
}

struct GranuleRow
{
    std::uint64_t id;
    Vec3 position, velocity, spin;
    double radius = 0, diameter = 0, count = 1, material = 0, mass = 0;
    double temperature = 0, moisture = 0, layer_mass = 0;  // where granules have these columns
};

std::vector<GranuleRow> granule_rows(Simulation& simulation)
{
    auto const& g = simulation.granules();
    std::vector<GranuleRow> rows;
    for (std::size_t r = 0; r < g.owned; ++r) {
        GranuleRow row{.id = g.id[r],
                       .position = g.position[r],
                       .velocity = g.velocity[r],
                       .spin = g.spin[r],
                       .radius = g.radius[r],
                       .diameter = g.real_diameter(r),
                       .count = g.real_count(r),
                       .material = static_cast<double>(g.material[r]),
                       .mass = g.mass[r]};
        if (g.groups.process) {
            row.temperature = g.temperature[r];
            row.moisture = g.water[r] / (g.core_mass[r] + g.layer_mass[r] + g.solute[r]);
            row.layer_mass = g.layer_mass[r];
        }
        rows.push_back(row);
    }
    rows = gathered(simulation.comm(), rows);
    std::sort(rows.begin(), rows.end(), [](auto const& a, auto const& b) { return a.id < b.id; });
    return rows;
}

struct DropletRow
{
    Vec3 position, velocity;
    double diameter, temperature, moisture;
};

//! One owned gas cell with its global place.
struct CellRow
{
    int i, j, k;
    double open, pressure, voidage, temperature, humidity, potential;
    Vec3 velocity;
    double eddy_viscosity, turbulent_energy;
};

std::vector<CellRow> cell_rows(Simulation& simulation)
{
    auto const& grid = simulation.grid();
    auto const& gas = simulation.gas();
    auto const velocity = simulation.solver().cell_velocity(gas);
    auto const eddies = simulation.solver().eddy_viscosity(gas);
    std::vector<CellRow> rows;
    grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
        rows.push_back({i + grid.shift[0],
                        j + grid.shift[1],
                        k + grid.shift[2],
                        grid.open_volume[c] / grid.volume(i, j, k),
                        gas.pressure[c],
                        gas.voidage[c],
                        gas.temperature[c],
                        air::loading(gas.vapour_fraction[c]),
                        simulation.local_drying_potential(gas.temperature[c], gas.vapour_fraction[c]),
                        {velocity[0][c], velocity[1][c], velocity[2][c]},
                        eddies.empty() ? 0 : eddies[c],
                        gas.turbulent ? gas.energy_of_eddies[c] : 0});
    });
    rows = gathered(simulation.comm(), rows);
    std::sort(rows.begin(), rows.end(),
              [](auto const& a, auto const& b) { return std::tie(a.k, a.j, a.i) < std::tie(b.k, b.j, b.i); });
    return rows;
}

template <class Rows, class Pick>
io::NamedArray column(std::string name, Rows const& rows, Pick&& pick, io::Precision precision = io::Precision::single)
{
    io::NamedArray out{.name = std::move(name), .precision = precision};
    if constexpr (std::is_same_v<std::decay_t<decltype(pick(rows.front()))>, Vec3>) {
        out.components = 3;
        for (auto const& row : rows) {
            Vec3 const v = pick(row);
            out.values.insert(out.values.end(), {v.x, v.y, v.z});
        }
    } else {
        for (auto const& row : rows) out.values.push_back(pick(row));
    }
    return out;
}

//! Cells of equal size across which stretched ones are shown: as narrow as the narrowest, but not too many.
std::vector<int> even_cells(std::vector<double> const& faces)
{
    double const length = faces.back() - faces.front();
    double narrowest = length;
    for (std::size_t i = 0; i + 1 < faces.size(); ++i) narrowest = std::min(narrowest, faces[i + 1] - faces[i]);
    int const many = std::max(static_cast<int>(faces.size()) - 1, 512);
    std::vector<int> out(static_cast<std::size_t>(std::min(many, static_cast<int>(std::lround(length / narrowest)))));
    for (std::size_t i = 0; i < out.size(); ++i) {
        double const x = faces.front() + (static_cast<double>(i) + 0.5) * length / static_cast<double>(out.size());
        out[i] = static_cast<int>(std::upper_bound(faces.begin() + 1, faces.end() - 1, x) - faces.begin()) - 1;
    }
    return out;
}

io::GasSlice slice(std::vector<CellRow> const& cells, grid::Grid const& grid, double y)
{
    auto const& [xs, ys, zs] = grid.lines;
    int const j = static_cast<int>(std::upper_bound(ys.begin() + 1, ys.end() - 1, y) - ys.begin()) - 1;
    auto const columns = even_cells(xs), layers = even_cells(zs);
    io::GasSlice out{.nx = static_cast<int>(columns.size()),
                     .nz = static_cast<int>(layers.size()),
                     .x0 = xs.front(),
                     .z0 = zs.front(),
                     .dx = (xs.back() - xs.front()) / static_cast<double>(columns.size()),
                     .dz = (zs.back() - zs.front()) / static_cast<double>(layers.size())};
    if (cells.empty()) return out;  // not the rank that writes
    int const nx = grid.global[0], ny = grid.global[1];
    for (int const k : layers)
        for (int const i : columns) {
            auto const& cell = cells[static_cast<std::size_t>((k * ny + j) * nx + i)];
            out.speed.push_back(math::norm(cell.velocity));
            out.temperature.push_back(cell.temperature);
            out.humidity.push_back(cell.humidity);
            out.voidage.push_back(cell.voidage);
            out.drying_potential.push_back(cell.potential);
            out.open.push_back(cell.open);
        }
    return out;
}

io::GranuleView view_of(std::vector<GranuleRow> const& granules, std::vector<product::LayerSum> const& layers,
                        bool process)
{
    io::GranuleView view;
    for (auto const& row : granules) {
        view.position.push_back(row.position);
        view.velocity.push_back(row.velocity);
        view.spin.push_back(row.spin);
        view.id.push_back(static_cast<double>(row.id));
        view.material.push_back(row.material);
        view.mass.push_back(row.mass);
        view.radius.push_back(row.radius);
        view.diameter.push_back(row.diameter);
        view.count.push_back(row.count);
        if (!process) continue;
        view.temperature.push_back(row.temperature);
        view.moisture.push_back(row.moisture);
        bool const layered = row.id < layers.size() && layers[row.id].solids > 0;
        view.porosity.push_back(layered ? layers[row.id].prediction().mean : std::numeric_limits<double>::quiet_NaN());
        view.layer_mass.push_back(row.layer_mass);
    }
    return view;
}
}

Output::Output(std::string folder, Simulation& simulation, io::Sections const* saved)
    : folder_(std::move(folder)),
      simulation_(simulation),
      root_(simulation.comm().root()),
      walls_(folder_, simulation),
      boxes_(folder_, simulation),
      probes_(folder_, simulation),
      granules_(folder_ + "/granules.pvd"),
      droplets_(folder_ + "/droplets.pvd"),
      gas_(folder_ + "/gas.pvd"),
      layers_(simulation.data().spray.present ? static_cast<std::size_t>(simulation.data().granules.first_free) : 0),
      surfaces_(simulation.data().seed, simulation.data().spray.present ? simulation.data().granules.first_free : 0,
                root_ ? simulation.data().output.surfaces : 0),
      model_(porosity_model(simulation.data()))
{
    if (!root_) return;
    std::filesystem::create_directories(folder_ + "/vtk");
    std::vector<io::SeriesColumn> columns{{"time", "s"},
                                          {"bed_temperature", "K"},
                                          {"outlet_temperature", "K"},
                                          {"outlet_humidity", "kg/kg"},
                                          {"drying_potential", "1"},
                                          {"pressure_drop", "Pa"},
                                          {"weight_over_area", "Pa"},
                                          {"bed_height", "m"},
                                          {"highest_granule", "m"},
                                          {"inlet_temperature", "K"},
                                          {"spray_rate", "kg/s"},
                                          {"bed_moisture", "kg/kg"},
                                          {"water_on_granules", "kg"},
                                          {"sprayed_solids", "kg"},
                                          {"sprayed_water", "kg"},
                                          {"evaporated_water", "kg"},
                                          {"deposited_solids", "kg"},
                                          {"wall_solids", "kg"},
                                          {"overspray_solids", "kg"},
                                          {"in_flight_solids", "kg"},
                                          {"coldest", "K"},
                                          {"hottest", "K"},
                                          {"kinetic_energy", "J"},
                                          {"coordination_number", "1"},
                                          {"overlap_mean", "1"},
                                          {"overlap_p99", "1"},
                                          {"overlap_largest", "1"},
                                          {"rotation_energy", "J"},
                                          {"potential_energy", "J"},
                                          {"elastic_energy", "J"},
                                          {"dissipated_energy", "J"},
                                          {"wall_work", "J"},
                                          {"wall_force_x", "N"},
                                          {"wall_force_y", "N"},
                                          {"wall_force_z", "N"},
                                          {"fed_mass", "kg"},
                                          {"discharged_mass", "kg"},
                                          {"discharged_granules", "1"}};
    if (simulation.data().contact.hard()) columns.push_back({"collisions", "1"});
    series_ = std::make_unique<io::SeriesWriter>(folder_ + "/timeseries.csv", columns);
    std::vector<io::EventColumn> event_columns;
    for (auto const& c : drying::event_columns)
        event_columns.push_back({std::string(c.name), std::string(c.unit), std::string(c.doc)});
    if (simulation.data().spray.present) {
        events_ = std::make_unique<io::EventsWriter>(folder_ + "/events.h5", event_columns);
        event_log_ = std::make_unique<io::RowLog>(folder_ + "/checkpoint/events.rows", event_columns.size());
    }
    io::write_surface(folder_ + "/vtk/walls.vtp", chamber_walls(simulation.data()));
    io::Collection(folder_ + "/walls.pvd").add(0, "vtk/walls.vtp");
    if (saved)
        go_on(*saved);
    else if (event_log_)
        event_log_->begin();
}

void Output::sample()
{
    Sample const s{simulation_.time(), simulation_.readings(), simulation_.totals(),
                   bed_statistics(simulation_.granules(), simulation_.mover(), simulation_.comm(),
                                  simulation_.data().output.overlap_criterion),
                   simulation_.traffic()};
    walls_.sample();
    boxes_.sample();
    probes_.sample();
    simulation_.mover().begin_interval();
    if (!root_) return;
    samples_.push_back(s);
    write(s);
}

void Output::write(Sample const& s)
{
    auto const& r = s.readings;
    auto const& t = s.totals;
    auto const& inlets = simulation_.data().gas.inlets;
    double const gone = s.traffic.left_energy - s.traffic.fed_energy;
    energy_passed_ = std::max(energy_passed_, s.bed.translation + s.bed.rotation + s.bed.dissipated);
    energy_residual_ = s.bed.energy() + s.bed.dissipated + gone - s.bed.wall_work - samples_.front().bed.energy();
    std::vector<double> row{s.time,
                            r.bed_temperature,
                            r.outlet_temperature,
                            r.outlet_humidity,
                            r.eta,
                            r.pressure_drop,
                            r.weight_over_area,
                            r.height,
                            r.highest,
                            inlets.empty() ? std::nan("") : inlets.front().temperature,
                            simulation_.data().spray.rate,
                            r.bed_moisture,
                            r.water_on_granules,
                            t.solids,
                            t.water,
                            t.evaporated,
                            t.deposited,
                            t.walls,
                            t.overspray,
                            t.in_flight,
                            r.coldest,
                            r.hottest,
                            r.kinetic_energy,
                            s.bed.coordination,
                            s.bed.overlap_mean,
                            s.bed.overlap_p99,
                            s.bed.overlap_largest,
                            s.bed.rotation,
                            s.bed.potential,
                            s.bed.elastic,
                            s.bed.dissipated,
                            s.bed.wall_work,
                            s.bed.wall_force.x,
                            s.bed.wall_force.y,
                            s.bed.wall_force.z,
                            s.traffic.fed_mass,
                            s.traffic.left_mass,
                            static_cast<double>(s.traffic.left)};
    if (simulation_.data().contact.hard()) row.push_back(static_cast<double>(s.bed.collisions));
    series_->append(row);
}

void Output::count(drying::Event const& event)
{
    if (event.initial >= 1) return;
    ++event_count_;
    surfaces_.take(event, simulation_.data().spray.solids_density);
    auto const prediction = std::visit(
        [&](auto const& law) {
            return law({event.mean_drying_potential, event.drying_time, event.moisture_at_impact});
        },
        model_);
    layers_[static_cast<std::size_t>(event.granule)].add(event.solids * (1 - event.initial) * (1 - event.imbibed),
                                                         prediction);
}

void Output::events()
{
    auto const fresh = simulation_.take_events();
    if (!root_ || !events_) return;
    for (auto const& event : fresh) count(event);
    static_assert(sizeof(drying::Event) % sizeof(double) == 0);
    std::span<double const> const rows{reinterpret_cast<double const*>(fresh.data()),
                                       fresh.size() * sizeof(drying::Event) / sizeof(double)};
    event_log_->append(rows);
    events_->append(rows);
    events_->flush();
}

void Output::look_at_granules()
{
    auto const granules = granule_rows(simulation_);
    if (root_) view_ = view_of(granules, layers_, simulation_.granules().groups.process);
}

void Output::picture()
{
    auto const granules = granule_rows(simulation_);
    std::vector<DropletRow> droplets;
    for (auto const& d : simulation_.droplets())
        droplets.push_back(
            {d.position, d.velocity, d.diameter(spray_liquid(simulation_.data())), d.temperature, d.water / d.solute});
    droplets = gathered(simulation_.comm(), droplets);
    std::vector<CellRow> cells;
    if (simulation_.has_gas()) cells = cell_rows(simulation_);
    if (!root_) return;

    double const time = simulation_.time();
    auto const name = [this](char const* kind, char const* ending) {
        return fmt::format("vtk/{}_{:06d}.{}", kind, pictures_, ending);
    };
    std::vector<Vec3> places;
    for (auto const& row : granules) places.push_back(row.position);
    bool const process = simulation_.granules().groups.process;
    std::vector<io::NamedArray> arrays{
        column(
            "id", granules, [](auto const& r) { return static_cast<double>(r.id); }, io::Precision::twice),
        column("radius [m]", granules, [](auto const& r) { return r.radius; }),
        column("velocity [m/s]", granules, [](auto const& r) { return r.velocity; }),
        column("diameter [m]", granules, [](auto const& r) { return r.diameter; })};
    if (process) {
        arrays.push_back(column("temperature [K]", granules, [](auto const& r) { return r.temperature; }));
        arrays.push_back(column("moisture [kg/kg]", granules, [](auto const& r) { return r.moisture; }));
        arrays.push_back(column("layer mass [kg]", granules, [](auto const& r) { return r.layer_mass; }));
    } else {
        arrays.push_back(column("spin [rad/s]", granules, [](auto const& r) { return r.spin; }));
        arrays.push_back(column("material", granules, [](auto const& r) { return r.material; }));
    }
    io::write_points(folder_ + "/" + name("granules", "vtp"), places, arrays);
    granules_.add(time, name("granules", "vtp"));
    io::Snapshot snapshot;
    snapshot.time = time;
    snapshot.mid_plane = io::mid_plane(simulation_.data().chamber);
    snapshot.outline = io::mid_plane_outline(simulation_.data().chamber);
    for (auto const& nozzle : simulation_.data().spray.nozzles) snapshot.nozzles.push_back(nozzle.position);
    snapshot.granules = view_of(granules, layers_, process);
    places.clear();
    for (auto const& row : droplets) {
        places.push_back(row.position);
        snapshot.droplets.diameter.push_back(row.diameter);
    }
    snapshot.droplets.position = places;
    if (simulation_.data().spray.present) {
        io::write_points(folder_ + "/" + name("droplets", "vtp"), places,
                         {column("velocity [m/s]", droplets, [](auto const& r) { return r.velocity; }),
                          column("diameter [m]", droplets, [](auto const& r) { return r.diameter; }),
                          column("temperature [K]", droplets, [](auto const& r) { return r.temperature; }),
                          column("moisture [kg/kg]", droplets, [](auto const& r) { return r.moisture; })});
        droplets_.add(time, name("droplets", "vtp"));
    }
    if (simulation_.has_gas()) {
        auto const& grid = simulation_.grid();
        std::string const file = name("gas", "vtr");
        std::vector<io::NamedArray> columns{
            column("open", cells, [](auto const& r) { return r.open; }),
            column("velocity [m/s]", cells, [](auto const& r) { return r.velocity; }),
            column("pressure [Pa]", cells, [](auto const& r) { return r.pressure; }),
            column("voidage", cells, [](auto const& r) { return r.voidage; }),
            column("temperature [K]", cells, [](auto const& r) { return r.temperature; }),
            column("humidity [kg/kg]", cells, [](auto const& r) { return r.humidity; }),
            column("drying potential", cells, [](auto const& r) { return r.potential; })};
        if (simulation_.data().gas.turbulence.model != "laminar")
            columns.push_back(column("eddy viscosity [m2/s]", cells, [](auto const& r) { return r.eddy_viscosity; }));
        if (simulation_.gas().turbulent)
            columns.push_back(
                column("turbulent energy [m2/s2]", cells, [](auto const& r) { return r.turbulent_energy; }));
        io::write_cells(folder_ + "/" + file, grid.lines, columns);
        gas_.add(time, file);
        snapshot.gas = slice(cells, grid, snapshot.mid_plane);
    }
    io::write_snapshot(folder_ + "/snapshots.h5", snapshot);
    view_ = std::move(snapshot.granules);
    walls_.picture(pictures_);
    ++pictures_;
}
}
