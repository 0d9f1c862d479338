#include "granum/dem/wall_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
using geometry::BodySearch;
using geometry::most_touches;
using geometry::Nearest;
using kernel::block;

namespace
{
// Contacts that turn by more than this between two steps are two contacts: the cosine of 30 degrees.
constexpr double same_contact = 0.86602540378443865;

constexpr double steps = 1048575;  // of a code, along each side of its square

// Whether a contact goes on in one that pushes along `now`. What a record keeps of a direction decides, so that a
// restart changes nothing; it is asked for only where it matters.
bool goes_on(Vec3 const& former, Vec3 const& now)
{
    double const cosine = dot(former, now);
    if (std::abs(cosine - same_contact) > 1e-4) return cosine > same_contact;
    return dot(direction_of(code_of(former)), now) > same_contact;
}

Vec3 corner(geometry::Bounds const& box, int which)
{
    return {(which & 1) != 0 ? box.upper.x : box.lower.x, (which & 2) != 0 ? box.upper.y : box.lower.y,
            (which & 4) != 0 ? box.upper.z : box.lower.z};
}
}

std::uint64_t code_of(Vec3 const& direction)
{
    // Octahedral map: both halves of the octahedron unfolded into one square.
    double const size = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    double u = direction.x / size, v = direction.y / size;
    if (direction.z < 0) {
        double const folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
        u = folded;
    }
    auto const number = [](double x) {
        return static_cast<std::uint64_t>(std::min((x + 1) * (0.5 * steps) + 0.5, steps));
    };
    return number(u) << 20 | number(v);
}

Vec3 direction_of(std::uint64_t code)
{
    double u = static_cast<double>(code >> 20 & 0xFFFFF) / (0.5 * steps) - 1;
    double v = static_cast<double>(code & 0xFFFFF) / (0.5 * steps) - 1;
    double const z = 1 - std::abs(u) - std::abs(v);
    if (z < 0) {
        double const unfolded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
        u = unfolded;
    }
    Vec3 const out{u, v, z};
    return out / norm(out);
}

WallContacts::WallContacts(std::vector<geometry::Body> const& bodies, Domain const& domain) : domain_(domain)
{
    bodies_.reserve(bodies.size());
    for (auto const& body : bodies) {
        auto& made = bodies_.emplace_back(Moving{.search = BodySearch(body), .motions = body.motions});
        made.in_place = geometry::rotations_in_place(body);
        made.box = geometry::bounds(body);
        made.origin = body.origin;
        made.material = body.material;
        if (body.shapes.size() == 1 && body.motions.empty())
            if (auto const* plane = std::get_if<geometry::Plane>(&body.shapes[0])) made.plane = *plane;
        for (auto const& motion : body.motions)
            if (auto const* servo = std::get_if<geometry::Servo>(&motion); servo != nullptr && !made.servo)
                made.servo = *servo;
        any_servo_ = any_servo_ || made.servo;
        any_motion_ = any_motion_ || !made.motions.empty();
    }
    go_to(0, 0);
}

void WallContacts::clear()
{
    near_.clear();
    facets_.clear();
    granules_.clear();
    body_.clear();
    touching_.clear();
    near_begin_.assign(1, 0);
    block_begin_.assign(1, 0);
    size_ = 0;
}

void WallContacts::go_to(double time, double dt)
{
    time_ = time;
    for (auto& body : bodies_) {
        if (body.motions.empty()) continue;
        if (body.servo) body.state.travelled += body.state.speed * dt;
        body.pose = geometry::pose(body.motions, body.in_place, time, body.state);
    }
}

double WallContacts::moved() const
{
    double farthest2 = 0;
    for (auto const& body : bodies_) {
        if (body.motions.size() == body.in_place) continue;
        if (!body.pose.turned) {
            farthest2 = std::max(farthest2, norm2(body.pose.shift - body.built.shift));
            continue;
        }
        // A displacement is a convex function of the place: none is larger than that of a corner of the box.
        bool const endless = !finite(body.box.lower) || !finite(body.box.upper);
        for (int which = 0; which < 8; ++which) {
            Vec3 const reach = body.reach * (corner({{-1, -1, -1}, {1, 1, 1}}, which));
            Vec3 const drawn = endless ? body.built.to_body(corner({domain_.lower, domain_.upper}, which))
                                       : corner(body.box, which) + reach;
            farthest2 = std::max(farthest2, norm2(body.pose.to_space(drawn) - body.built.to_space(drawn)));
        }
    }
    return std::sqrt(farthest2);
}

void WallContacts::make(Frame const& frame, Layers const& layers, double room, double farthest,
                        std::function<std::uint32_t(std::uint32_t)> const& row_now, kernel::Rules const& rules,
                        kernel::Energy& lost)
{
    struct Known
    {
        std::uint32_t row;
        Id partner;
        History history;
    };
    std::vector<Known> known;
    for (std::size_t k = 0; k < size_; ++k)
        if (touches(k))
            if (auto const now = row_now(row(k)); now < frame.owned) known.push_back({now, partner(k), history(k)});

    clear();
    for (auto& body : bodies_) {
        body.built = body.pose;
        body.reach = farthest + room;
    }
    layers_ = &layers;
    near_begin_.assign(1, 0);
    block_begin_.assign(1, 0);
    for (std::size_t unit = 0; unit < layers.units(); ++unit) {
        for (auto const row : layers.rows(unit))
            for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
                auto const& plane = bodies_[b].plane;
                Vec3 const x = frame.position(row);
                double const reach = frame.radius(row) + frame.room(row) + room;
                if (plane && dot(x - plane->point, plane->normal) >= reach) continue;
                std::size_t const first = facets_.size();
                look_around(x, reach, b);
                auto const places = static_cast<std::uint32_t>(std::min(facets_.size() - first, most_touches));
                if (places == 0) continue;
                near_.push_back({row, b, static_cast<std::uint32_t>(size_), places, first});
                granules_.insert(granules_.end(), places, kernel::place_of(row));
                body_.insert(body_.end(), places, b);
                size_ += places;
            }
        size_ = (size_ + block - 1) / block * block;
        granules_.resize(size_, kernel::place_of(frame.lonely()));
        body_.resize(size_, 0);
        near_begin_.push_back(near_.size());
        block_begin_.push_back(size_ / block);
    }
    std::size_t const padded = size_;
    material_.assign(padded, 0);
    for (std::size_t k = 0; k < size_; ++k) material_[k] = static_cast<std::uint8_t>(bodies_[body_[k]].material);
    history_.assign(padded * columns_, 0.0);
    overlap_.assign(padded, 0.0);
    touching_.assign(padded / block, 0);
    for (auto* triples : {&normal_, &velocity_, &spin_, &force_, &torque_})
        for (auto& numbers : *triples) numbers.assign(padded, 0.0);
    for (auto const& [row, partner, history] : known) {
        if (find(row, body_of(partner)) != nullptr)
            set(row, partner, history);
        else if (rules.ledger)
            lost.add(rules, history[columns_ - 1], 1);
    }
}

// Facets of a body near a point, and near its images where it may cross a periodic face before the list is made anew.
void WallContacts::look_around(Vec3 const& x, double reach, std::uint32_t b)
{
    auto const& body = bodies_[b];
    std::size_t const first = facets_.size();
    body.search.near(body.pose.to_body(x), reach, facets_);
    std::array<Vec3, 8> images{x};
    std::size_t count = 1;
    for (std::size_t d = 0; d < 3; ++d) {
        if (!domain_.periodic[d]) continue;
        double const length = domain_.upper[d] - domain_.lower[d];
        double const over = x[d] < domain_.lower[d] + reach ? length : x[d] > domain_.upper[d] - reach ? -length : 0;
        if (over == 0) continue;
        for (std::size_t k = 0, so_far = count; k < so_far; ++k) {
            images[count] = images[k];
            images[count++][d] += over;
        }
    }
    if (count == 1) return;
    for (std::size_t k = 1; k < count; ++k) body.search.near(body.pose.to_body(images[k]), reach, facets_);
    auto const from = facets_.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(from, facets_.end());
    facets_.erase(std::unique(from, facets_.end()), facets_.end());
}

WallContacts::Near const* WallContacts::find(std::uint32_t row, std::uint32_t body) const
{
    if (near_.empty()) return nullptr;
    auto const unit = layers_->unit_of(row);
    auto const begin = near_.begin() + static_cast<std::ptrdiff_t>(near_begin_[unit]),
               end = near_.begin() + static_cast<std::ptrdiff_t>(near_begin_[unit + 1]);
    auto const at = std::lower_bound(begin, end, std::pair{row, body}, [](Near const& a, auto const& b) {
        return std::pair{a.row, a.body} < b;
    });
    return at != end && at->row == row && at->body == body ? &*at : nullptr;
}

History WallContacts::history(std::size_t k) const
{
    History out{};
    for (std::size_t c = 0; c < columns_; ++c) out[c] = history_[(k / block * columns_ + c) * block + k % block];
    return out;
}

Id WallContacts::partner(std::size_t k) const
{
    return Id{body_[k]} << 40 | code_of(normal(k));
}

void WallContacts::set(std::uint32_t row, Id partner, History const& history)
{
    Near const* const near = find(row, body_of(partner));
    if (near == nullptr) return;
    std::size_t k = near->place;
    while (k + 1 < near->place + near->places && touches(k)) ++k;
    for (std::size_t c = 0; c < columns_; ++c) history_at(k, c) = history[c];
    put(normal_, k, direction_of(partner));
    touching_[k / block] = static_cast<std::uint8_t>(touching_[k / block] | 1u << (k % block));
}

void WallContacts::end(std::size_t k, kernel::Rules const& rules, kernel::Energy& lost)
{
    if (rules.ledger) lost.add(rules, history_at(k, columns_ - 1), 1);
    for (std::size_t c = 0; c < columns_; ++c) history_at(k, c) = 0;
    touching_[k / block] = static_cast<std::uint8_t>(touching_[k / block] & ~(1u << (k % block)));
}

// Sorts contacts into places such that each finds the history of the contact that it goes on from. Normals of the
// touches are in space.
void WallContacts::place_touches(Near const& near, double radius, std::span<Nearest const> touches_now,
                                 kernel::Rules const& rules, kernel::Energy& lost)
{
    constexpr std::size_t none = most_touches;
    std::array<std::size_t, most_touches> place;
    place.fill(none);
    std::array<bool, most_touches> taken{};
    auto const former = [&](std::size_t p) { return touches(near.place + p); };

    std::size_t formers = 0, last = 0;
    for (std::size_t p = 0; p < near.places; ++p)
        if (former(p)) ++formers, last = p;
    if (formers == 1 && touches_now.size() == 1) {
        if (goes_on(normal(near.place + last), touches_now[0].normal)) place[0] = last, taken[last] = true;
    } else if (formers > 0) {
        std::array<std::uint64_t, most_touches> code{};
        for (std::size_t p = 0; p < near.places; ++p)
            if (former(p)) code[p] = code_of(normal(near.place + p));
        for (;;) {  // the best of all pairs first
            double best = same_contact;
            std::size_t best_touch = none, best_place = none;
            for (std::size_t t = 0; t < touches_now.size(); ++t)
                for (std::size_t p = 0; p < near.places; ++p) {
                    if (place[t] != none || taken[p] || !former(p)) continue;
                    double const cosine = dot(direction_of(code[p]), touches_now[t].normal);
                    if (cosine > best || (cosine == best && best_touch == t && code[p] < code[best_place]))
                        best = cosine, best_touch = t, best_place = p;
                }
            if (best_touch == none) break;
            place[best_touch] = best_place;
            taken[best_place] = true;
        }
    }
    for (std::size_t t = 0; t < touches_now.size(); ++t) {
        if (place[t] != none) continue;
        std::size_t free = none;
        for (std::size_t p = 0; p < near.places; ++p)
            if (!taken[p] && (free == none || (former(free) && !former(p)))) free = p;
        if (former(free)) end(near.place + free, rules, lost);
        place[t] = free;
        taken[free] = true;
    }

    for (std::size_t p = 0; p < near.places; ++p) overlap_[near.place + p] = 0;
    for (std::size_t t = 0; t < touches_now.size(); ++t) {
        put(normal_, near.place + place[t], touches_now[t].normal);
        overlap_[near.place + place[t]] = radius - touches_now[t].distance;
    }
}

void WallContacts::measure(Layers::Range const& units, kernel::Rules const& rules, Frame const& frame,
                           kernel::Energy& lost)
{
    for (std::size_t n = near_begin_[units.begin]; n < near_begin_[units.end]; ++n) {
        Near const& near = near_[n];
        Moving const& body = bodies_[near.body];
        std::size_t const end_of_facets = n + 1 < near_.size() ? near_[n + 1].facet : facets_.size();
        std::span const facets(facets_.data() + near.facet, end_of_facets - near.facet);
        Vec3 const x = frame.position(near.row);
        double const radius = frame.radius(near.row);
        if (body.plane) {  // the commonest wall, without the search among shapes
            double const distance = dot(x - body.plane->point, body.plane->normal);
            overlap_[near.place] = distance < radius ? radius - distance : 0;
            put(normal_, near.place, body.plane->normal);
            continue;
        }
        std::array<Nearest, most_touches> found;
        std::size_t const count = body.search.touches(body.pose.to_body(x), radius, facets, scratch_, found);
        if (body.pose.turned)
            for (std::size_t t = 0; t < count; ++t) found[t].normal = body.pose.direction_to_space(found[t].normal);
        place_touches(near, radius, {found.data(), count}, rules, lost);
        for (std::size_t k = near.place; k < near.place + near.places; ++k) {
            if (overlap_[k] == 0 || body.motions.empty()) continue;
            double const lever = radius - rules.lever_shift * overlap_[k];
            put(velocity_, k, body.pose.velocity_at(x - lever * normal(k)));
            put(spin_, k, body.pose.spin);
        }
    }
}

void WallContacts::for_each_beside(Frame const& frame, double gap,
                                   std::function<void(std::uint32_t, std::uint32_t, double)> const& what) const
{
    BodySearch::Scratch scratch;
    for (std::size_t n = 0; n < near_.size(); ++n) {
        Near const& near = near_[n];
        Moving const& body = bodies_[near.body];
        Vec3 const x = frame.position(near.row);
        double const radius = frame.radius(near.row);
        if (body.plane) {
            double const distance = dot(x - body.plane->point, body.plane->normal);
            if (distance >= radius && distance < radius + gap) what(near.row, near.body, distance);
            continue;
        }
        std::size_t const end = n + 1 < near_.size() ? near_[n + 1].facet : facets_.size();
        std::array<Nearest, most_touches> found;
        std::size_t const count = body.search.touches(body.pose.to_body(x), radius + gap,
                                                      {facets_.data() + near.facet, end - near.facet}, scratch, found);
        for (std::size_t t = 0; t < count; ++t)
            if (found[t].distance >= radius) what(near.row, near.body, found[t].distance);
    }
}

void WallContacts::run(Layers::Range const& units, kernel::Kernel const& kernel, kernel::Rules const& rules,
                       Frame& frame, double dt, kernel::Seen& seen)
{
    std::size_t const blocks = block_begin_[units.end] - block_begin_[units.begin];
    if (blocks == 0) return;
    measure(units, rules, frame, seen.dissipated);
    std::size_t const first = block * block_begin_[units.begin];
    auto const numbers = [first](Triples& of) {
        return std::array{of[0].data() + first, of[1].data() + first, of[2].data() + first};
    };
    auto const n = numbers(normal_), v = numbers(velocity_), w = numbers(spin_), f = numbers(force_),
               t = numbers(torque_);
    kernel.walls({.rules = &rules,
                  .bodies = frame.bodies.data(),
                  .material = frame.material.data(),
                  .blocks = blocks,
                  .granule = granules_.data() + first,
                  .wall_material = material_.data() + first,
                  .overlap = overlap_.data() + first,
                  .normal = {n[0], n[1], n[2]},
                  .velocity = {v[0], v[1], v[2]},
                  .spin = {w[0], w[1], w[2]},
                  .history = history_.data() + first * columns_,
                  .touching = touching_.data() + block_begin_[units.begin],
                  .dt = dt,
                  .force = {f[0], f[1], f[2]},
                  .torque = {t[0], t[1], t[2]},
                  .collisions = frame.counted()},
                 seen);
}

void WallContacts::finish(kernel::Rules const& rules, Frame const& frame, double dt, par::Communicator const& comm)
{
    work_ = {};
    if (any_motion_ && rules.ledger) add_work(rules, frame, dt);
    if (!any_servo_) return;
    auto const sums = tally(frame, comm, true);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        auto& body = bodies_[b];
        if (!body.servo) continue;
        Vec3 const force{sums[b][0].value(), sums[b][1].value(), sums[b][2].value()};
        double const before = body.state.speed;
        body.state.speed = geometry::servo_speed(*body.servo, before, force, sums[b][6].value(), time_, dt);
        // This force acts over half of the way behind and half of that ahead, which has another speed.
        if (comm.root() && rules.ledger)
            work_.add(rules, 0.5 * dt * (before - body.state.speed) * dot(body.servo->direction, force), 1);
    }
}

// Work of the moving walls on the granules in a step: at the contact, and by the couple beside it.
void WallContacts::add_work(kernel::Rules const& rules, Frame const& frame, double dt)
{
    for (std::size_t k = 0; k < size_; ++k) {
        if (!touches(k) || bodies_[body_[k]].motions.empty()) continue;
        double const lever = frame.radius(row(k)) - rules.lever_shift * overlap_[k];
        Vec3 const force = get(force_, k), couple = get(torque_, k) + lever * cross(normal(k), force);
        work_.add(rules, (dot(force, velocity(k)) + dot(couple, get(spin_, k))) * dt, 1);
    }
}

std::vector<WallContacts::ExactLoad> WallContacts::tally(Frame const& frame, par::Communicator const& comm,
                                                         bool servos_only) const
{
    std::vector<ExactLoad> sums(bodies_.size());
    for (std::size_t k = 0; k < size_; ++k) {
        auto const& body = bodies_[body_[k]];
        if (!touches(k) || (servos_only && !body.servo)) continue;
        // What the body receives is the opposite of what the granule receives, moment included.
        Vec3 const force = -get(force_, k);
        Vec3 const arm = frame.position(row(k)) - body.pose.to_space(body.origin);
        Vec3 const torque = cross(arm, force) - get(torque_, k);
        for (std::size_t d = 0; d < 3; ++d) {
            sums[body_[k]][d].add(force[d]);
            sums[body_[k]][3 + d].add(torque[d]);
        }
        if (body.servo) sums[body_[k]][6].add(1 / frame.bodies[row(k)].inverse_mass);
    }
    if (!sums.empty()) comm.sum(std::span(sums.front().data(), sums.size() * std::tuple_size_v<ExactLoad>));
    return sums;
}

Vec3 WallContacts::force() const
{
    std::array<base::ExactSum, 3> sums;
    for (std::size_t k = 0; k < size_; ++k)
        for (std::size_t d = 0; d < 3; ++d) sums[d].add(force_[d][k]);
    return {sums[0].value(), sums[1].value(), sums[2].value()};
}

std::vector<WallLoad> WallContacts::loads(Frame const& frame, par::Communicator const& comm) const
{
    std::vector<WallLoad> out;
    for (auto const& sum : tally(frame, comm, false))
        out.push_back(
            {{sum[0].value(), sum[1].value(), sum[2].value()}, {sum[3].value(), sum[4].value(), sum[5].value()}});
    return out;
}

std::vector<geometry::ServoState> WallContacts::servos() const
{
    std::vector<geometry::ServoState> out;
    for (auto const& body : bodies_) out.push_back(body.state);
    return out;
}

void WallContacts::servos(std::vector<geometry::ServoState> const& states)
{
    for (std::size_t b = 0; b < std::min(states.size(), bodies_.size()); ++b) bodies_[b].state = states[b];
    go_to(time_, 0);
}
}
