// Turntables by the built program, stopped in every way.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>
#include <vector>

#include "morph/mesh/io.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"
#include "tests/files.h"
#include "tests/render/program/process.h"

namespace fs = std::filesystem;

namespace {

/// Name and bytes of every file.
std::map<std::string, std::string> files_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    if (!fs::exists(folder)) return files;
    for (const auto& entry : fs::directory_iterator(folder))
        files[entry.path().filename().string()] = content(entry.path());
    return files;
}

int count_frames(const fs::path& folder) {
    if (!fs::exists(folder)) return 0;
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder))
        count += entry.path().extension() == ".png" || entry.path().extension() == ".exr" ? 1 : 0;
    return count;
}

int status_of(const TemporaryFolder& folder, const std::string& arguments) {
    Process run(folder.path(), arguments);
    const int status = run.wait();
    INFO(arguments << ": " << run.err());
    CHECK(status == 0);
    return status;
}

std::string error_of(const TemporaryFolder& folder, const std::string& arguments, rlim_t largest_file = 0) {
    Process run(folder.path(), arguments, largest_file);
    CHECK(run.wait() == 1);
    CHECK(lines_in(run.err()) == 1);
    CHECK(run.err().rfind("automorph: ", 0) == 0);
    return run.err();
}

void make_shapes(const TemporaryFolder& folder) {
    automorph::write_mesh(folder / "a.off",
                          automorph::ellipsoid({1, 0.8, 0.5}, {.triangles = 200, .seed = 2}));
    automorph::write_mesh(folder / "b.ply", automorph::star({}, {.triangles = 300}));
}

const std::string kSmall = " -q --frames 12 --width 64 --height 48 --spp 16";
const std::string kMorph = "turntable a.off b.ply --alignment none" + kSmall;

/// Waits until so many frames are there.
bool wait_for_frames(Process& run, const fs::path& folder, int count) {
    while (run.is_running()) {
        if (count_frames(folder) >= count) return true;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return false;
}

}  // namespace

TEST_CASE("kill -9 at any moment costs the frame in flight, and the rerun makes the undisturbed sequence") {
    const TemporaryFolder folder;
    make_shapes(folder);
    for (const std::string extension : {".png", ".exr"}) {
        const std::string command = kMorph + " --out ";
        REQUIRE(status_of(folder, command + "calm/f_" + extension) == 0);
        const auto calm = files_in(folder / "calm");
        REQUIRE(calm.size() == 12);
        int kills = 0;
        for (int round = 0; round < 4; ++round) {
            Process run(folder.path(), command + "killed/f_" + extension);
            if (!wait_for_frames(run, folder / "killed", 3 * round)) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(3 * round));
            run.send(SIGKILL);
            if (run.wait() == 1000 + SIGKILL) ++kills;
            // Every frame that is there is whole.
            for (const auto& [name, bytes] : files_in(folder / "killed")) {
                if (fs::path(name).extension() == extension) CHECK(bytes == calm.at(name));
            }
        }
        CHECK(kills >= 2);
        // What a kill between writing and renaming leaves; the process is over.
        const pid_t dead = ::fork();
        if (dead == 0) ::_exit(0);
        ::waitpid(dead, nullptr, 0);
        std::ofstream(folder / ("killed/f_005" + extension + "." + std::to_string(dead) + "-3.part"))
            << "half";
        fs::resize_file(folder / ("killed/f_000" + extension), 500);
        REQUIRE(status_of(folder, command + "killed/f_" + extension) == 0);
        CHECK(files_in(folder / "killed") == calm);
        fs::remove_all(folder / "calm");
        fs::remove_all(folder / "killed");
    }
}

TEST_CASE("a rerun makes nothing anew but what changed", "[sweep]") {
    const TemporaryFolder folder;
    make_shapes(folder);
    const std::string command = "turntable a.off --out t/f_.png" + kSmall;
    const auto made_by = [&](const std::string& arguments) {
        std::map<std::string, fs::file_time_type> before;
        for (const auto& entry : fs::directory_iterator(folder / "t"))
            before[entry.path().filename().string()] = fs::last_write_time(entry.path());
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        REQUIRE(status_of(folder, arguments) == 0);
        int made = 0;
        for (const auto& entry : fs::directory_iterator(folder / "t")) {
            const auto old = before.find(entry.path().filename().string());
            made += old == before.end() || old->second != fs::last_write_time(entry.path()) ? 1 : 0;
        }
        return made;
    };
    REQUIRE(status_of(folder, command) == 0);
    const auto first = files_in(folder / "t");
    CHECK(made_by(command) == 0);
    CHECK(made_by(command + " --threads 1") == 0);
    // The same content at another time and under another name is the same mesh.
    fs::copy_file(folder / "a.off", folder / "copy.off");
    CHECK(made_by("turntable copy.off --out t/f_.png" + kSmall) == 0);
    CHECK(made_by(command + " --frame-range 3-5 --seed 9") == 3);
    CHECK(made_by(command) == 3);
    CHECK(files_in(folder / "t") == first);
    for (const char* change :
         {" --elevation 20", " --start 10", " --shutter 0.5", " --up z", " --flat", " --fov 30"}) {
        INFO(change);
        CHECK(made_by(command + change) == 12);
    }
    automorph::write_mesh(folder / "a.off",
                          automorph::ellipsoid({1, 0.8, 0.6}, {.triangles = 200, .seed = 2}));
    CHECK(made_by(command + " --fov 30") == 12);
    CHECK(made_by(command + " --fov 30 --redo") == 12);
}

TEST_CASE("parts of a sequence are those of the whole, and threads do not matter", "[sweep]") {
    const TemporaryFolder folder;
    make_shapes(folder);
    const std::string command = kMorph;
    REQUIRE(status_of(folder, command + " --threads 1 --out whole/f_.png") == 0);
    REQUIRE(status_of(folder, command + " --frame-range 7- --threads 3 --out parts/f_.png") == 0);
    CHECK(count_frames(folder / "parts") == 5);
    REQUIRE(status_of(folder, command + " --frame-range 0-6 --out parts/f_.png") == 0);
    CHECK(files_in(folder / "parts") == files_in(folder / "whole"));
    // A loop has no frame twice.
    std::vector<std::string> all;
    for (const auto& [name, bytes] : files_in(folder / "whole")) all.push_back(bytes);
    std::sort(all.begin(), all.end());
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE("Ctrl-C and a polite kill end at once with a line that says how to go on") {
    const TemporaryFolder folder;
    make_shapes(folder);
    const std::string command = "turntable a.off --out t/f_.png" + kSmall;
    REQUIRE(status_of(folder, "turntable a.off --out calm/f_.png" + kSmall) == 0);
    for (const auto& [signal, status] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        Process run(folder.path(), command);
        REQUIRE(wait_for_frames(run, folder / "t", 2));
        run.send(signal);
        CHECK(run.wait() == status);
        CHECK(run.err() == "automorph: stopped; the same command again goes on, finished frames are kept\n");
        const auto calm = files_in(folder / "calm");
        for (const auto& [name, bytes] : files_in(folder / "t")) {
            INFO(name);
            REQUIRE(calm.count(name) == 1);
            CHECK(bytes == calm.at(name));
        }
        fs::remove_all(folder / "t");
    }
}

TEST_CASE("a full disk, a folder that cannot be written and wrong options are one line, with nothing left") {
    const TemporaryFolder folder;
    make_shapes(folder);
    const auto before = files_in(folder.path());
    const std::string command = "turntable a.off" + kSmall + " --out ";
    const std::string full = error_of(folder, command + "t/f_.png", 2000);
    CHECK(full.find("t/f_000.png: cannot be written: File too large") != std::string::npos);
    CHECK(files_in(folder / "t").empty());
    REQUIRE(status_of(folder, command + "t/f_.png") == 0);  // room again: it goes on
    CHECK(files_in(folder / "t").size() == 12);
    fs::remove_all(folder / "t");

    CHECK(error_of(folder, command + "a.off/f_.png").find("a.off: cannot be used as output folder") !=
          std::string::npos);
    CHECK(error_of(folder, command + "/proc/turn/f_.png").find("/proc/turn: cannot be used") !=
          std::string::npos);
    CHECK(error_of(folder, command + "f_.jpg").find("f_.jpg: a turntable is written as .png") !=
          std::string::npos);
    CHECK(error_of(folder, "turntable gone.off -q --out f_.png").find("gone.off: cannot be read") !=
          std::string::npos);
    CHECK(error_of(folder, command + "f_.png --frame-range 5-12").find("--frame-range 5-12") !=
          std::string::npos);
    CHECK(error_of(folder, command + "f_.png --up w").find("axis 'w'") != std::string::npos);
    CHECK(error_of(folder, command + "f_.png --up z --view z").find("along the up axis") !=
          std::string::npos);
    CHECK(error_of(folder, command + "f_.png --shutter 1.5").find("--shutter") != std::string::npos);
    CHECK(error_of(folder, command + "f_.png --hold 0.1").find("TARGET") != std::string::npos);
    CHECK(files_in(folder.path()) == before);
}

TEST_CASE("a mesh that cannot be morphed can be turned") {
    const TemporaryFolder folder;
    // Two tetrahedra.
    std::ofstream(folder / "two.off")
        << "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 0\n4 0 0\n3 1 0\n3 0 1\n"
           "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n";
    CHECK(status_of(folder, "turntable two.off -q --frames 2 --width 16 --height 16 --spp 1 --out t_.png") ==
          0);
    CHECK(count_frames(folder.path()) == 2);
}

TEST_CASE("a video is made of the frames by ffmpeg, once") {
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0) {
        WARN("skipped: there is no ffmpeg");
        return;
    }
    const TemporaryFolder folder;
    make_shapes(folder);
    for (const std::string name : {"v%d.mp4", "v.webm"}) {
        const std::string command =
            "turntable a.off -q --frames 5 --width 31 --height 22 --spp 2 --out " + name;
        const fs::path frames = folder / (fs::path(name).stem().string() + "_frames");
        REQUIRE(status_of(folder, command + " --frame-range 0-2") == 0);
        CHECK(!fs::exists(folder / name));
        CHECK(count_frames(frames) == 3);
        REQUIRE(status_of(folder, command) == 0);
        const std::string video = content(folder / name);
        CHECK(video.size() > 500);
        const auto time = fs::last_write_time(folder / name);
        REQUIRE(status_of(folder, command) == 0);
        CHECK(fs::last_write_time(folder / name) == time);
        std::ofstream(folder / name) << "broken";
        REQUIRE(status_of(folder, command) == 0);
        CHECK(content(folder / name) == video);
        REQUIRE(status_of(folder, command + " --fps 12") == 0);
        CHECK(content(folder / name) != video);
    }
    CHECK(files_in(folder / "v_frames").size() == 6);  // and the record
}

TEST_CASE("what is told follows the log level") {
    const TemporaryFolder folder;
    make_shapes(folder);
    const std::string command =
        "turntable a.off --frames 2 --width 16 --height 16 --spp 1 --out t/f_.png --redo";
    const auto told = [&](const std::string& level) {
        Process run(folder.path(), command + " --log-level " + level);
        CHECK(run.wait() == 0);
        return std::pair(run.out(), run.err());
    };
    CHECK(told("error") == std::pair<std::string, std::string>());
    CHECK(told("warning") == std::pair<std::string, std::string>());
    const auto info = told("info"), debug = told("debug");
    CHECK(info.first.find("t/f_000.png ... t/f_001.png") != std::string::npos);
    CHECK(info.second.find("turntable: ") == 0);
    CHECK(lines_in(info.second) == 1);
    CHECK(debug.second.find("automorph: frame 1: alpha 0.0000, 180.00 degrees") != std::string::npos);
    Process wrong(folder.path(), command + " --log-level loud");
    CHECK(wrong.wait() == 1);
}
