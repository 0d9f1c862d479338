#include "granum/io/checkpoint.hpp"

#include "granum/base/error.hpp"
#include "granum/io/hash.hpp"
#include "granum/io/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <sstream>

namespace granum::io
{
namespace
{
namespace fs = std::filesystem;
constexpr std::size_t longest_manifest = 16u << 20;
constexpr int most_ranks = 100000;
constexpr int keep_every = 10;

std::string folder_name(std::string const& path, int number)
{
    return fmt::format("{}/{:06d}", path, number);
}

std::string file_name(int rank)
{
    return fmt::format("rank_{:05d}", rank);
}

//! The number of a folder name of six digits or more; nothing for anything else.
std::optional<int> number_of(std::string const& name)
{
    int number = 0;
    auto const [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (name.size() < 6 || failure != std::errc() || end != name.data() + name.size() || number < 0) return {};
    return number;
}

//! Numbers of the finished folders, rising.
std::vector<int> numbers(std::string const& path)
{
    std::vector<int> out;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(path, missing))
        if (auto const number = number_of(entry.path().filename().string())) out.push_back(*number);
    std::sort(out.begin(), out.end());
    return out;
}

std::string manifest_text(CheckpointLabel const& label, std::vector<Seal> const& seals)
{
    std::string text =
        fmt::format("granum checkpoint\nformat 1\nprogram {}\ncase {:016x}\ntime {}\nstep {}\nranks {}\n",
                    label.program, label.case_hash, label.time, label.step, seals.size());
    for (std::size_t rank = 0; rank < seals.size(); ++rank)
        text += fmt::format("{} {} {:016x}\n", file_name(static_cast<int>(rank)), seals[rank].size, seals[rank].hash);
    return text + fmt::format("seal {:016x}\n", hash_of(text));
}

//! Text of rank 0 on every rank.
std::string told(par::Communicator const& comm, std::string const& text)
{
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    comm.broadcast(bytes);
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

//! The messages of all ranks that have one, on every rank; empty if none has.
std::string first_failure(par::Communicator const& comm, std::string const& mine)
{
    auto const all = comm.gather(std::as_bytes(std::span(mine.data(), mine.size())));
    return told(comm, {reinterpret_cast<char const*>(all.data()), all.size()});
}
}

Checkpoint read_manifest(std::string const& folder)
{
    auto const path = folder + "/manifest";
    std::error_code missing;
    auto const size = fs::file_size(path, missing);
    if (missing) throw base::IoError(fmt::format("{}: no manifest", folder));
    if (size > longest_manifest) throw base::IoError(fmt::format("{}: is too long for a manifest", path));
    auto const text = read_text(path);
    auto const last = text.rfind("seal ");
    if (last == std::string::npos || text.substr(last) != fmt::format("seal {:016x}\n", hash_of(text.substr(0, last))))
        throw base::IoError(fmt::format("{}: is damaged (checksum)", path));
    // Behind its checksum the text is as we wrote it; another version's may still be of another form.
    Checkpoint out;
    out.folder = folder;
    std::istringstream in(text.substr(0, last));
    std::string line, word;
    std::getline(in, line);
    int format = 0;
    in >> word >> format;
    if (line != "granum checkpoint" || word != "format" || format != 1)
        throw base::IoError(fmt::format("{}: has format {}; this version reads format 1", path, format));
    in >> word >> out.label.program >> word >> std::hex >> out.label.case_hash >> std::dec >> word >> out.label.time >>
        word >> out.label.step >> word >> out.label.ranks;
    if (!in || out.label.ranks < 1 || out.label.ranks > most_ranks)
        throw base::IoError(fmt::format("{}: is no manifest", path));
    for (int rank = 0; rank < out.label.ranks; ++rank) {
        Seal seal;
        in >> word >> seal.size >> std::hex >> seal.hash >> std::dec;
        if (!in || word != file_name(rank)) throw base::IoError(fmt::format("{}: is no manifest", path));
        out.seals.push_back(seal);
    }
    return out;
}

Sections Checkpoint::read(int writer) const
{
    return read_sections(folder + "/" + file_name(writer), seals.at(static_cast<std::size_t>(writer)));
}

CheckpointFolder::CheckpointFolder(std::string path, par::Communicator const& comm, SystemCalls const& calls)
    : path_(std::move(path)), comm_(comm), calls_(calls)
{
}

void CheckpointFolder::sweep() const
{
    if (comm_.root()) {
        std::error_code missing;
        std::vector<fs::path> left;
        for (auto const& entry : fs::directory_iterator(path_, missing))
            if (entry.path().extension() == ".tmp" || entry.path().extension() == ".old") left.push_back(entry.path());
        for (auto const& folder : left) fs::remove_all(folder, missing);
    }
    comm_.barrier();
}

void CheckpointFolder::clear() const
{
    if (comm_.root()) {
        std::error_code missing;
        for (int const number : numbers(path_)) {
            auto const folder = folder_name(path_, number);
            fs::rename(folder, folder + ".old", missing);
        }
    }
    sweep();
}

//! Rank 0 makes the folder before the others come. Returns what went wrong, or nothing.
std::string CheckpointFolder::write_mine(int number, Sections const& mine, Seal& seal) const
{
    auto const folder = folder_name(path_, number) + ".tmp";
    std::string wrong;
    if (comm_.root()) {
        try {
            if (!fs::is_directory(path_)) {
                make_folder(calls_, path_);
                auto const parent = fs::path(path_).parent_path().string();
                sync_folder(calls_, parent.empty() ? "." : parent);
            }
            std::error_code missing;
            fs::remove_all(folder, missing);
            make_folder(calls_, folder);
        } catch (base::IoError const& error) {
            wrong = error.what();
        }
    }
    wrong = told(comm_, wrong);
    if (!wrong.empty()) return wrong;
    try {
        seal = write_sections(calls_, folder + "/" + file_name(comm_.rank()), mine);
    } catch (std::exception const& error) {
        wrong = error.what();
    }
    return first_failure(comm_, wrong);
}

std::string CheckpointFolder::finish(int number, CheckpointLabel const& label, std::vector<Seal> const& seals) const
{
    auto const folder = folder_name(path_, number);
    try {
        auto const manifest = manifest_text(label, seals);
        write_durably(calls_, folder + ".tmp/manifest", {std::as_bytes(std::span(manifest.data(), manifest.size()))});
        sync_folder(calls_, folder + ".tmp");
        rename_durably(calls_, folder + ".tmp", folder);
    } catch (std::exception const& error) {
        return error.what();
    }
    return "";
}

int CheckpointFolder::write(CheckpointLabel label, Sections const& mine) const
{
    auto const there = numbers(path_);
    int const number = static_cast<int>(comm_.max(comm_.root() && !there.empty() ? there.back() + 1L : 0L));
    Seal seal;
    auto wrong = write_mine(number, mine, seal);
    if (wrong.empty()) {
        auto const bytes = comm_.gather(std::as_bytes(std::span(&seal, 1)));
        if (comm_.root()) {
            std::vector<Seal> seals(bytes.size() / sizeof(Seal));
            std::memcpy(seals.data(), bytes.data(), bytes.size());
            label.ranks = comm_.size();
            wrong = finish(number, label, seals);
        }
        wrong = told(comm_, wrong);
    }
    if (!wrong.empty()) {
        std::error_code missing;
        if (comm_.root()) fs::remove_all(folder_name(path_, number) + ".tmp", missing);
        throw base::IoError("checkpoint: " + wrong);
    }
    if (comm_.root()) prune(number);
    return number;
}

void CheckpointFolder::prune(int newest) const
{
    std::error_code missing;
    auto const all = numbers(path_);
    for (std::size_t k = 0; k + 2 < all.size(); ++k) {
        if (all[k] % keep_every == 0 || all[k] >= newest) continue;
        auto const folder = folder_name(path_, all[k]);
        fs::rename(folder, folder + ".old", missing);
        if (!missing) fs::remove_all(folder + ".old", missing);
    }
}

std::optional<Checkpoint> CheckpointFolder::newest(std::vector<std::string>& passed_over) const
{
    long found = -1;
    std::string reasons;
    if (comm_.root()) {
        auto const all = numbers(path_);
        for (auto number = all.rbegin(); number != all.rend() && found < 0; ++number) {
            try {
                auto const checkpoint = read_manifest(folder_name(path_, *number));
                for (int writer = 0; writer < checkpoint.label.ranks; ++writer) (void)checkpoint.read(writer);
                found = *number;
            } catch (std::exception const& error) {
                reasons += fmt::format("checkpoint {:06d} is passed over: {}\n", *number, error.what());
            }
        }
    }
    found = comm_.max(found);
    std::istringstream lines(told(comm_, reasons));
    for (std::string line; std::getline(lines, line);) passed_over.push_back(line);
    if (found < 0) return std::nullopt;
    auto out = read_manifest(folder_name(path_, static_cast<int>(found)));
    out.number = static_cast<int>(found);
    return out;
}
}
