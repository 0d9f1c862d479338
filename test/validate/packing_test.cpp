// How densely poured spheres pack: a cloud that falls between periodic sides onto a plane, measured away from its ends.
// Published: Scott and Kilgour, J. Phys. D 2 (1969) 863 [R] (0.6366 shaken down); Agnolin and Roux, arXiv
// 0705.3194 (2007), abstract (pressed together without friction 0.639 and 6 contacts, with friction 0.3 as loose as
// 0.593); Jerkins et al., Phys. Rev. Lett. 101 (2008) 018301, abstract (0.550 as loose as rough spheres stand).
#include "bed.hpp"

#include <map>

namespace
{
using namespace granum;
using namespace validate;

struct Packing
{
    double solids, coordination;
};

Packing pour(double friction, double rolling, Section& section, bool pictured = false)
{
    double const radius = 1e-3, diameter = 2 * radius, edge = 10 * diameter, dt = 1.2e-5;
    Scene scene({5e6, 0.25, 1500}, {.restitution = 0.5, .sliding_friction = friction, .rolling_friction = rolling});
    scene.settings.gravity = {0, 0, -9.81};
    scene.settings.lower = {0, 0, 0};
    scene.settings.upper = {edge, edge, 60 * diameter};
    scene.settings.periodic = {true, true, false};
    scene.slabs = {.origin = 0, .width = edge, .periodic = true};
    scene.add_plane({0, 0, 0}, {0, 0, 1});
    // A loose cloud whose granules fly about as they fall, so that nothing is left of the order they were set in.
    int const across = 8, layers = 44;
    for (int k = 0; k < layers; ++k)
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i) {
                base::Random random(1, base::Purpose::test, scene.granules.rows(), 0);
                double const spacing = edge / across;
                Vec3 const at{(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.7) * spacing};
                scene.add(at, 0.25 * Vec3{random.normal(), random.normal(), random.normal()}, radius, 1500);
            }
    scene.prepare();
    settle(scene, dt, 20'000, 45'000);

    std::vector<double> tops;
    for (std::size_t row = 0; row < scene.granules.owned; ++row) tops.push_back(scene.granules.position[row].z);
    std::sort(tops.begin(), tops.end());
    double const low = 5 * diameter, high = tops[tops.size() - tops.size() / 100] - 4 * diameter;
    std::map<particle::Id, double> touching;
    for (auto const& contact : scene.engine->contacts())
        if (!contact.wall) ++touching[contact.low], ++touching[contact.high];
    double inside = 0, contacts = 0;
    std::vector<double> shown;
    for (std::size_t row = 0; row < scene.granules.owned; ++row) {
        double const z = scene.granules.position[row].z;
        shown.push_back(touching[scene.granules.id[row]]);
        if (z > low && z < high) ++inside, contacts += shown.back();
    }
    if (pictured)
        section.picture(
            "packing",
            snapshot_of(scene, {{0, 0}, {edge, 0}, {edge, high + 5 * diameter}, {0, high + 5 * diameter}}, edge / 2),
            shown, {0, 8}, "Poured spheres with friction 0.5, cut; colour: number of contacts, 0 to 8");
    return {solids_between(scene, low, high, edge * edge), contacts / inside};
}

TEST(Packing, of_poured_spheres_is_between_random_loose_and_random_close)
{
    Section section(
        "Packing of poured spheres",
        "2816 spheres of 2 mm fall as a loose cloud between periodic sides onto a plane (10 x 10 diameters); "
        "measured from 5\ndiameters above the plane to 4 below the surface. Reference case dem-15. "
        "Restitution 0.5, Young's modulus 5 MPa.");
    std::string const poured = "recalled [R] (dem-15)",
                      frictionless = "Scott and Kilgour 1969 [R], Agnolin and Roux 2007: 0.639";
    auto const smooth = pour(0, 0, section);
    section.between("solids, without friction", 0.63, 0.65, frictionless, smooth.solids);
    section.tells("contacts of a sphere, without friction (6 in the limit of hard spheres)", smooth.coordination);
    std::vector<double> voids{1 - smooth.solids};
    for (double const friction : {0.1, 0.3, 0.5}) {
        auto const packing = pour(friction, 0, section, friction == 0.5);
        auto const name = fmt::format("friction {}", friction);
        if (friction < 0.3)
            section.between("solids, " + name, 0.58, 0.64, poured, packing.solids);
        else
            section.between("solids, " + name, 0.58, 0.61,
                            poured + (friction < 0.5 ? ", Agnolin and Roux 2007: above 0.593" : ""), packing.solids);
        section.tells("contacts of a sphere, " + name, packing.coordination);
        voids.push_back(1 - packing.solids);
    }
    auto const rolling = pour(0.5, 0.2, section);
    section.between("solids, friction 0.5, rolling friction 0.2", 0.55, 0.60, "Jerkins et al. 2008: above 0.550",
                    rolling.solids);
    voids.push_back(1 - rolling.solids);
    section.rising("voidage from smooth to rough", "dem-15", voids);
}
}
