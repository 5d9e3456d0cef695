// Commands of the built program, stopped in the midst of their work.

#include <pty.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <functional>

#include "morph/mesh/io.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"
#include "tests/render/program/process.h"

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

using Clock = std::chrono::steady_clock;

/// Processes that have been told of the folder.
int helpers_of(const fs::path& folder) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        std::ostringstream read;
        read << std::ifstream(entry.path() / "cmdline").rdbuf();  // nothing where the process has ended
        const std::string words = read.str();
        count += words.rfind("ffmpeg", 0) == 0 && words.find(folder.string()) != std::string::npos ? 1 : 0;
    }
    return count;
}

/// Files that are not whole, in the folder and below.
std::vector<std::string> parts_in(const fs::path& folder) {
    std::vector<std::string> parts;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".part") parts.push_back(entry.path().filename().string());
    }
    return parts;
}

/// Waits until `is_time`, false if the program ends before.
bool wait_for(Process& run, const std::function<bool()>& is_time) {
    while (run.is_running()) {
        if (is_time()) return true;
        std::this_thread::sleep_for(200us);
    }
    return false;
}

/// Stops the program, which is in the midst of `what`.
void stop(Process& run, const TemporaryFolder& folder, const std::string& what) {
    INFO(what << ": " << run.err());
    const auto begin = Clock::now();
    run.send(SIGINT);
    CHECK(run.wait() == 130);
    CHECK(Clock::now() - begin < 10s);  // at once, but on a busy machine
    const std::string told = run.err();
    CHECK((told.rfind("automorph: stopped\n") == told.size() - 19 || what == "turntable"));
    CHECK(parts_in(folder.path()).empty());
    CHECK(helpers_of(folder.path()) == 0);
}

void make_shapes(const TemporaryFolder& folder, int triangles) {
    automorph::write_mesh(folder / "a.off",
                          automorph::ellipsoid({1, 0.8, 0.5}, {.triangles = triangles, .seed = 2}));
    automorph::write_mesh(folder / "b.ply", automorph::star({}, {.triangles = triangles}));
}

/// A bent square of n x n vertices: quick to make, slow to read.
automorph::Mesh sheet(int n) {
    automorph::Mesh mesh{automorph::Points(n * n, 3), automorph::Triangles(2 * (n - 1) * (n - 1), 3)};
    int f = 0;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int v = j * n + i;
            mesh.V.row(v) << i, j, 0.001 * i * j;
            if (i + 1 == n || j + 1 == n) continue;
            mesh.F.row(f++) << v, v + 1, v + n;
            mesh.F.row(f++) << v + 1, v + n + 1, v + n;
        }
    }
    return mesh;
}

bool has_ffmpeg() {
    return std::system("command -v ffmpeg >/dev/null 2>&1") == 0;
}

/// The program on a terminal of so many columns, on which keys can be typed.
class OnTerminal {
public:
    OnTerminal(const fs::path& folder, std::size_t columns, std::vector<std::string> words) {
        const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
        words.insert(words.begin(), AUTOMORPH_PROGRAM);
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        process_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
        if (process_ != 0) return;
        for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
        if (::chdir(folder.c_str()) != 0) ::_exit(98);
        ::execv(pointers.front(), pointers.data());
        ::_exit(97);
    }
    ~OnTerminal() {
        ::kill(process_, SIGKILL);
        ::close(terminal_);
    }
    OnTerminal(const OnTerminal&) = delete;
    OnTerminal& operator=(const OnTerminal&) = delete;

    /// All that is shown until `is_time`, or the end.
    std::string read(const std::function<bool(const std::string&)>& is_time) {
        std::array<char, 4096> bytes;
        while (!is_time(shown_)) {
            const ssize_t count = ::read(terminal_, bytes.data(), bytes.size());
            if (count <= 0) break;  // EIO: nobody writes any more
            shown_.append(bytes.data(), static_cast<std::size_t>(count));
        }
        return shown_;
    }
    void type(char key) { CHECK(::write(terminal_, &key, 1) == 1); }
    termios settings() const {
        termios found{};
        ::tcgetattr(terminal_, &found);
        return found;
    }
    int wait() {
        int status = 0;
        ::waitpid(process_, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    }

private:
    pid_t process_ = 0;
    int terminal_ = -1;
    std::string shown_;
};

/// What was drawn to be overwritten.
std::vector<std::string> bars_in(const std::string& shown) {
    std::vector<std::string> bars;
    for (std::size_t begin = 0; (begin = shown.find('\r', begin)) != std::string::npos;) {
        const std::size_t end = shown.find("\x1b[K", ++begin);
        if (end != std::string::npos && shown.find_first_of("\r\n", begin) > end && end > begin)
            bars.push_back(shown.substr(begin, end - begin));
    }
    return bars;
}

/// Of UTF-8, first bytes.
std::size_t characters(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

}  // namespace

TEST_CASE("shape, info and morph stop at once wherever they are") {
    const TemporaryFolder folder;
    make_shapes(folder, 8000);
    automorph::write_mesh(folder / "big.stl", sheet(400));
    const auto before = names_in(folder.path());
    for (const std::string command :
         {"shape star new.ply --triangles 1000000", "shape head new.ply --triangles 1000000", "info big.stl",
          "morph a.off b.ply --out new.glb --report new.json"}) {
        for (const auto delay : {0ms, 150ms}) {
            Process run(folder.path(), command);
            REQUIRE(run.wait_until_it_catches(SIGINT));
            std::this_thread::sleep_for(delay);
            stop(run, folder, command);
            CHECK(names_in(folder.path()) == before);
        }
    }
    // While numbered files are written, each is whole.
    Process run(folder.path(), "morph a.off b.ply --alignment none --frames 2000 --out m/f_.off");
    REQUIRE(wait_for(run, [&] { return fs::exists(folder / "m/f_0003.off"); }));
    stop(run, folder, "writing frames");
    const auto size = fs::file_size(folder / "m/f_0000.off");
    for (const auto& entry : fs::directory_iterator(folder / "m")) CHECK(10 * entry.file_size() > 9 * size);
}

TEST_CASE("a figure stops in each of its stages, and what an earlier run made is whole") {
    const TemporaryFolder folder;
    make_shapes(folder, 1000);
    std::ofstream(folder / "f.yaml") << "source: a.off\ntarget: b.ply\nrows: [{label: x}, {label: y}]\n"
                                        "alphas: [0, 1/2, 1]\npicture: {width: 160, height: 160, spp: 16}\n"
                                        "video: {frames: 16, size: 120, spp: 8, turntable: 16}\n";
    std::vector<std::string> stages{"morph of row 1 (x): ", "pictures of row 1 (x): "};
    if (has_ffmpeg()) stages.insert(stages.end(), {"pictures of row 2 (y): ", "video of row 2 (y): "});
    for (const std::string& stage : stages) {
        Process run(folder.path(), "figure f.yaml");
        REQUIRE(wait_for(run, [&] { return run.err().find(stage) != std::string::npos; }));
        std::this_thread::sleep_for(100ms);
        stop(run, folder, stage);
        for (const auto& entry : fs::directory_iterator(folder / "out/f")) {
            INFO(entry.path());
            CHECK(entry.file_size() > 0);
        }
    }
    if (!has_ffmpeg()) return;
    // While ffmpeg writes.
    Process run(folder.path(), "figure f.yaml");
    REQUIRE(wait_for(run, [&] {
        const auto parts = parts_in(folder.path());
        return std::any_of(parts.begin(), parts.end(),
                           [](const std::string& name) { return name.rfind("turntable.", 0) == 0; });
    }));
    stop(run, folder, "turntable of a figure");
    CHECK(!fs::exists(folder / "out/f/turntable.mp4"));
}

TEST_CASE("a turntable stops while its video is made, and goes on from its frames") {
    if (!has_ffmpeg()) {
        WARN("skipped: there is no ffmpeg");
        return;
    }
    const TemporaryFolder folder;
    make_shapes(folder, 300);
    const std::string command =
        "turntable a.off --frames 24 --width 240 --height 240 --spp 1 --out v.webm --log-level warning";
    Process run(folder.path(), command);
    REQUIRE(wait_for(run, [&] { return helpers_of(folder.path()) > 0; }));
    stop(run, folder, "turntable");
    CHECK(!fs::exists(folder / "v.webm"));
    CHECK(names_in(folder / "v_frames").size() == 24);
    Process again(folder.path(), command);
    CHECK(again.wait() == 0);
    CHECK(names_in(folder / "v_frames").size() == 25);
    CHECK(fs::exists(folder / "v.webm"));
}

TEST_CASE("diff stops on large folders, also while it accepts") {
    const TemporaryFolder folder;
    make_shapes(folder, 300);
    for (const std::string seed : {"1", "2"}) {
        Process run(folder.path(), "turntable a.off -q --frames 2 --width 400 --height 400 --spp 1 --seed " +
                                       seed + " --out made/" + seed + "_.exr");
        REQUIRE(run.wait() == 0);
    }
    fs::create_directories(folder / "golden");
    fs::create_directories(folder / "new");
    constexpr int kPictures = 60;
    for (int i = 0; i < kPictures; ++i) {
        const std::string name = std::to_string(i) + ".exr";
        fs::copy_file(folder / "made/1_000.exr", folder / "golden" / name);
        fs::copy_file(folder / "made/2_000.exr", folder / "new" / name);
    }
    const std::string golden = content(folder / "golden/0.exr"), found = content(folder / "new/0.exr");
    Process run(folder.path(), "diff golden new --side-by-side why --report r.json");
    REQUIRE(run.wait_until_it_catches(SIGINT));
    std::this_thread::sleep_for(200ms);
    stop(run, folder, "comparing");
    CHECK(!fs::exists(folder / "r.json"));

    Process accepting(folder.path(), "diff golden new --accept");
    REQUIRE(wait_for(accepting, [&] {
        return accepting.out().find("replaced") != std::string::npos ||
               content(folder / "golden/0.exr") == found;
    }));
    stop(accepting, folder, "accepting");
    CHECK(names_in(folder / "golden").size() == kPictures);
    for (const auto& entry : fs::directory_iterator(folder / "golden")) {
        const std::string bytes = content(entry.path());
        CHECK((bytes == golden || bytes == found));
    }
}

TEST_CASE("Ctrl-C on a narrow terminal: no line wraps, the bar goes, the terminal stays as it was") {
    const TemporaryFolder folder;
    make_shapes(folder, 1000);
    std::ofstream(folder / "f.yaml")
        << "source: a.off\ntarget: b.ply\n"
           "rows: [{label: \"\u00e4\u00f6\u00fc \u03b1\u03b2\u03b3\u03b4\u03b5\u03b6 a long label\"}]\n"
           "picture: {width: 300, height: 300, spp: 256}\nvideo: {frames: 0, turntable: 0}\n";
    for (const std::size_t columns : {20u, 40u, 100u}) {
        OnTerminal terminal(folder.path(), columns, {"figure", "f.yaml"});
        terminal.read([](const std::string& shown) { return shown.find("pictures") != std::string::npos; });
        const termios before = terminal.settings();
        terminal.type('\x03');
        const std::string shown = terminal.read([](const std::string&) { return false; });
        CHECK(terminal.wait() == 130);
        const std::string end = "\r\x1b[Kautomorph: stopped\r\n";
        REQUIRE(shown.size() > end.size());
        CHECK(shown.substr(shown.size() - end.size()) == end);
        const std::vector<std::string> bars = bars_in(shown);
        CHECK(bars.size() > 1);
        for (const std::string& bar : bars) {
            INFO(bar);
            CHECK(characters(bar) < columns);
            CHECK(((bar.front() == '[') == (columns == 100) || bar.find(" %") == std::string::npos));
        }
        const termios after = terminal.settings();
        CHECK((after.c_lflag == before.c_lflag && after.c_iflag == before.c_iflag &&
               after.c_oflag == before.c_oflag));
    }
}
