// A case file as typed: TOML with the line of every entry, read key by key so that all mistakes are found in one pass.
//
// Whoever reads names each key once, with its default, range and one line of documentation. The reader keeps where each
// value came from (for `granum explain`) and knows every key that was asked for, so a key that nobody asked for is a
// mistake with a suggestion.
#pragma once

#include "granum/base/error.hpp"
#include "granum/io/units.hpp"
#include "granum/math/vec3.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace granum::io
{
//! Allowed values, SI.
struct Range
{
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_allowed = true;
};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), false};
inline constexpr Range not_negative{0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range zero_to_one{0, 1, true};

//! Where a resolved value came from.
struct Provenance
{
    std::string key, value, origin, doc;
};

class CaseFile
{
  public:
    //! Parses the file; files that it names are beside it or, for a copy of a case, in the folder `home`. Throws
    //! base::CaseError where it is missing, not readable or not TOML.
    explicit CaseFile(std::string path, std::string home = "");
    ~CaseFile();
    CaseFile(CaseFile const&) = delete;
    CaseFile& operator=(CaseFile const&) = delete;

    std::string const& path() const;
    std::string const& text() const;  //!< as read
    //! Where a file named in the case is: relative names are relative to the case.
    std::string beside(std::string const& name) const;
    //! Notes at `key`.contents what the file at `path` holds, so that a run can tell whether it is still the same.
    void note_contents(std::string const& key, std::string const& path);

    //! True where the key or section is written in the file. Does not make the key known.
    bool has(std::string const& key) const;
    //! True where the key is written and holds this text. Does not make the key known.
    bool says(std::string const& key, std::string const& text) const;
    //! Entries of an array, 0 where it is missing. Their keys are "name[0].entry".
    int count(std::string const& key);
    //! Names of the tables in a table, in the order of the alphabet: "a" and "b" of [key.a] and [key.b]. Makes the key
    //! known. A name with anything but letters, digits, - and _ is a mistake and left out.
    std::vector<std::string> names(std::string const& key);
    //! Makes a key known without reading it.
    void know(std::string const& key);
    //! Makes a section known.
    void section(std::string const& name);

    //! @{ The value of `key`; where it is missing, that of the section's material, else `fallback`, else a mistake and
    //! NaN (or an empty value). A wrong value is a mistake and gives the fallback or NaN, so reading goes on.
    double quantity(std::string const& key, Dimension dimension, std::optional<double> fallback, std::string const& doc,
                    Range range = {});
    std::optional<double> optional_quantity(std::string const& key, Dimension dimension, std::string const& doc,
                                            Range range = {});
    long integer(std::string const& key, std::optional<long> fallback, std::string const& doc, long low, long high);
    bool boolean(std::string const& key, bool fallback, std::string const& doc);
    std::string name(std::string const& key, std::optional<std::string> fallback, std::string const& doc,
                     std::vector<std::string> const& allowed, std::string const& kind);
    std::string words(std::string const& key, std::optional<std::string> fallback, std::string const& doc);
    math::Vec3 vector(std::string const& key, Dimension dimension, std::optional<math::Vec3> fallback,
                      std::string const& doc);
    std::vector<long> integers(std::string const& key, std::size_t length, std::string const& doc, long low, long high);
    //! A list of any length, at least one; all or nothing.
    std::vector<double> quantities(std::string const& key, Dimension dimension, std::string const& doc);
    std::vector<std::vector<double>> table(std::string const& key, std::size_t width, Dimension dimension,
                                           std::string const& doc);
    std::vector<std::string> list(std::string const& key, std::string const& doc,
                                  std::vector<std::string> const& allowed);
    //! @}

    //! Values of `file` but those of `left_out` stand in for missing keys of the section. Throws base::CaseError where
    //! the file is wrong.
    void use_material(std::string const& section, std::string const& name, std::string const& file,
                      std::vector<std::string> const& left_out = {});

    //! A mistake at the line of `key` (of its section where the key is not written).
    void mistake(std::string const& key, std::string const& what, std::vector<std::string> hints = {});
    //! The key has a wrong or missing value already reported: what follows from it is not worth a message.
    bool wrong(std::string const& key) const;
    bool any_mistake() const;
    //! A derived value, for explain.
    void derived(std::string const& key, std::string const& value, std::string const& doc);

    //! Reports keys that nobody asked for; throws base::CaseError if there is any mistake.
    void finish();

    std::vector<Provenance> const& provenance() const;
    std::vector<std::string> const& warnings() const;  //!< on values of low confidence in use

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
