#include "granum/geometry/stl.hpp"

#include "granum/base/error.hpp"
#include "granum/geometry/bounds.hpp"
#include "granum/geometry/closed_check.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>

namespace granum::geometry
{
namespace
{
constexpr std::size_t head_bytes = 84, triangle_bytes = 50;
constexpr std::size_t ascii_bytes_per_triangle = 500;  // a plain writer needs about 270
constexpr double farthest = 1e6;                       // of a coordinate, m

template <class... Arguments>
[[noreturn]] void fail(fmt::format_string<Arguments...> what, Arguments&&... arguments)
{
    throw base::IoError(fmt::format(what, std::forward<Arguments>(arguments)...));
}

std::uint32_t number_at(std::string const& bytes, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;) value = (value << 8) | static_cast<unsigned char>(bytes[at + k]);
    return value;
}

//! Whether the bytes begin a binary file of `size` bytes.
bool counted(std::string const& bytes, std::uint64_t size)
{
    return bytes.size() >= head_bytes &&
           size == head_bytes + triangle_bytes * static_cast<std::uint64_t>(number_at(bytes, 80));
}

std::string contents(std::string const& path, StlOptions const& options)
{
    std::error_code error;
    auto const status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail("{}: no such file", path);
    if (!std::filesystem::is_regular_file(status)) fail("{}: is not a file", path);
    auto const size = std::filesystem::file_size(path, error);
    if (error) fail("{}: cannot be read: {}", path, error.message());
    if (size > options.most_triangles * ascii_bytes_per_triangle)
        fail("{}: {} bytes are more than {} triangles can need; at most {} triangles are taken", path, size,
             options.most_triangles, options.most_triangles);
    std::ifstream in(path, std::ios::binary);
    std::string bytes(std::min<std::size_t>(size, head_bytes), '\0');
    auto const read = [&](std::size_t from) {
        if (!in || !in.read(bytes.data() + from, static_cast<std::streamsize>(bytes.size() - from)))
            fail("{}: cannot be read", path);
    };
    read(0);
    // A head that announces too many and fits the size is answered before the rest is read.
    if (counted(bytes, size) && number_at(bytes, 80) > options.most_triangles)
        fail("{}: {} triangles; at most {} are taken", path, number_at(bytes, 80), options.most_triangles);
    std::size_t const begun = bytes.size();
    bytes.resize(static_cast<std::size_t>(size));
    read(begun);
    return bytes;
}

Vec3 placed(Vec3 const& corner, StlOptions const& options, std::string const& place, std::size_t triangle)
{
    if (!finite(corner)) fail("{}: a corner of triangle {} is not a finite number", place, triangle);
    Vec3 const x = options.scale * corner + options.shift;
    if (!(std::abs(x.x) <= farthest && std::abs(x.y) <= farthest && std::abs(x.z) <= farthest))
        fail("{}: a corner of triangle {} lies at ({:g}, {:g}, {:g}) m, more than {:g} m away; is the unit right?",
             place, triangle, x.x, x.y, x.z, farthest);
    return x;
}

std::vector<Triangle> binary(std::string const& path, std::string const& bytes, StlOptions const& options)
{
    std::size_t const count = number_at(bytes, 80);
    std::vector<Triangle> out(count);
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
            Vec3 corner;
            std::size_t const at = head_bytes + k * triangle_bytes + 12 + 12 * c;
            for (std::size_t d = 0; d < 3; ++d)
                corner[d] = static_cast<double>(std::bit_cast<float>(number_at(bytes, at + 4 * d)));
            out[k][c] = placed(corner, options, path, k + 1);
        }
    return out;
}

//! A word of a file as it can be shown: short, without what a terminal would act on.
std::string shown(std::string_view word)
{
    std::string out;
    for (char const c : word.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
    return word.size() > 40 ? out + "..." : out;
}

//! The words of an ASCII file in the order of its grammar.
class Words
{
  public:
    Words(std::string const& path, std::string_view text) : path_(path), text_(text) {}

    std::string place() const { return fmt::format("{}:{}", path_, line_); }

    //! The next word; empty at the end.
    std::string_view next()
    {
        while (at_ < text_.size() && blank(text_[at_])) line_ += text_[at_++] == '\n';
        std::size_t const begin = at_;
        while (at_ < text_.size() && !blank(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }

    void skip_line()
    {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    }

    static bool same(std::string_view word, std::string_view lower_case)
    {
        return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(), [](char a, char b) {
            return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
        });
    }

    void expect(std::string_view wanted, std::size_t triangle)
    {
        auto const word = next();
        if (same(word, wanted)) return;
        if (word.empty()) fail("{}: the file ends within triangle {}, where \"{}\" belongs", place(), triangle, wanted);
        fail("{}: \"{}\" stands where \"{}\" belongs (triangle {})", place(), shown(word), wanted, triangle);
    }

    double number(std::size_t triangle)
    {
        auto word = next();
        if (word.empty()) fail("{}: the file ends within triangle {}, where a number belongs", place(), triangle);
        auto const digits = word.front() == '+' ? word.substr(1) : word;
        double value = 0;
        auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error == std::errc::result_out_of_range && end == digits.data() + digits.size()) {
            bool const tiny = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos;
            return tiny ? 0.0 : std::numeric_limits<double>::infinity();
        }
        if (error != std::errc{} || end != digits.data() + digits.size())
            fail("{}: \"{}\" is not a number (triangle {})", place(), shown(word), triangle);
        return value;
    }

    Vec3 triple(std::size_t triangle)
    {
        double const x = number(triangle), y = number(triangle), z = number(triangle);
        return {x, y, z};
    }

  private:
    static bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

    std::string const& path_;
    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
};

std::vector<Triangle> ascii(std::string const& path, std::string const& bytes, StlOptions const& options)
{
    Words words(path, bytes);
    std::vector<Triangle> out;
    bool open = false;  // between "solid" and "endsolid"
    for (;;) {
        auto const word = words.next();
        std::size_t const triangle = out.size() + 1;
        if (word.empty()) break;
        if (!open && Words::same(word, "solid")) {
            open = true;
            words.skip_line();
        } else if (open && Words::same(word, "endsolid")) {
            open = false;
            words.skip_line();
        } else if (open && Words::same(word, "facet")) {
            if (triangle > options.most_triangles)
                fail("{}: more than {} triangles", words.place(), options.most_triangles);
            words.expect("normal", triangle);
            words.triple(triangle);
            words.expect("outer", triangle);
            words.expect("loop", triangle);
            Triangle corners;
            for (auto& corner : corners) {
                words.expect("vertex", triangle);
                corner = words.triple(triangle);
                corner = placed(corner, options, words.place(), triangle);
            }
            words.expect("endloop", triangle);
            words.expect("endfacet", triangle);
            out.push_back(corners);
        } else {
            fail("{}: \"{}\" stands where \"{}\" belongs", words.place(), shown(word),
                 open ? "facet\" or \"endsolid" : "solid");
        }
    }
    if (open) fail("{}: the file ends without \"endsolid\"; it may be cut off", words.place());
    return out;
}

//! Whether the file begins as an ASCII one.
bool says_solid(std::string const& bytes)
{
    auto const begin = bytes.find_first_not_of(" \t\r\n");
    return begin != std::string::npos && bytes.size() >= begin + 5 &&
           Words::same(std::string_view(bytes).substr(begin, 5), "solid");
}
}

StlMesh read_stl(std::string const& path, StlOptions const& options)
{
    if (!(options.scale > 0) || !std::isfinite(options.scale) || !finite(options.shift))
        fail("{}: a scale of {:g} and a shift of ({:g}, {:g}, {:g}) m place nothing", path, options.scale,
             options.shift.x, options.shift.y, options.shift.z);
    std::string const bytes = contents(path, options);
    if (bytes.empty()) fail("{}: is empty", path);
    // Many binary files begin with "solid" as well: what decides is whether the count fits the size.
    bool const is_binary = counted(bytes, bytes.size());
    if (!is_binary && !says_solid(bytes)) {
        if (bytes.size() < head_bytes)
            fail("{}: is no STL file: it does not begin with \"solid\" and has only {} bytes", path, bytes.size());
        fail(
            "{}: is no STL file: it does not begin with \"solid\", and the {} triangles that its head announces would "
            "need {} bytes where there are {}; it may be cut off",
            path, number_at(bytes, 80), head_bytes + triangle_bytes * static_cast<std::uint64_t>(number_at(bytes, 80)),
            bytes.size());
    }
    auto triangles = is_binary ? binary(path, bytes, options) : ascii(path, bytes, options);
    if (triangles.empty()) fail("{}: has no triangles", path);

    Bounds box;
    for (auto const& triangle : triangles)
        for (auto const& corner : triangle) box.widen(corner);
    double const least_height = lowest_triangle * box.size();
    StlMesh out;
    for (auto const& triangle : triangles) {
        bool const flat = !(triangle_height(triangle) > least_height);
        if (flat) ++out.degenerate;
        if (!flat || options.keep_flat) out.mesh.triangles.push_back(triangle);
    }
    if (out.degenerate == triangles.size()) fail("{}: none of its {} triangles has an area", path, triangles.size());
    return out;
}
}
