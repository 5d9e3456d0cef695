#include "morph/mesh/write_file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_gate.h"
#include "tests/catch.h"
#include "tests/files.h"

using namespace automorph;
namespace fs = std::filesystem;

namespace {

/// Runs `work` in a process of its own; returns its exit status.
template <class Work>
int status_of(const Work& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::_exit(99);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("a file is replaced as a whole, and a failure leaves the old one and nothing else") {
    const TemporaryFolder folder;
    write_file(folder / "a", "one");
    write_file(folder / "a", "two");
    CHECK(content(folder / "a") == "two");
    CHECK_THROWS_AS(write_file(folder / "a/b", "three"), IoError);
    CHECK_THROWS_AS(write_file(folder / "gone/b", "three"), IoError);
    fs::create_directory(folder / "d");
    CHECK_THROWS_AS(write_file(folder / "d", "three"), IoError);
    CHECK(names_in(folder.path()) == std::set<std::string>{"a", "d"});
    // A limit on sizes of files stands for a full disk.
    const int status = status_of([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_file(folder / "a", std::string(100000, 'x'));
        } catch (const IoError&) {
            ::_exit(7);
        }
    });
    CHECK(status == 7);
    CHECK(content(folder / "a") == "two");
    CHECK(names_in(folder.path()) == std::set<std::string>{"a", "d"});
}

TEST_CASE("a symbolic link stays one, and the file that it names is written") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "store");
    write_file(folder / "store/a", "one");
    fs::create_symlink("store/a", folder / "link");
    fs::create_symlink("link", folder / "link-to-link");
    fs::create_symlink(folder / "store/b", folder / "to-come");
    fs::create_directory_symlink("store", folder / "folder");
    write_file(folder / "link-to-link", "two");
    write_file(folder / "to-come", "three");
    write_file(folder / "folder/c", "four");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(fs::is_symlink(folder / "link-to-link"));
    CHECK(fs::is_symlink(folder / "to-come"));
    CHECK(content(folder / "store/a") == "two");
    CHECK(content(folder / "store/b") == "three");
    CHECK(names_in(folder / "store") == std::set<std::string>{"a", "b", "c"});

    fs::create_symlink("circle", folder / "circle");
    fs::create_symlink("gone/d", folder / "nowhere");
    CHECK_THROWS_AS(write_file(folder / "circle", "five"), IoError);
    CHECK_THROWS_AS(write_file(folder / "nowhere", "five"), IoError);
}

TEST_CASE("a file that is replaced keeps its permissions, and one that is write-protected its content") {
    const TemporaryFolder folder;
    write_file(folder / "mine", "one");
    fs::permissions(folder / "mine", fs::perms::owner_read | fs::perms::owner_write);
    write_file(folder / "mine", "two");
    CHECK(content(folder / "mine") == "two");
    CHECK(fs::status(folder / "mine").permissions() == (fs::perms::owner_read | fs::perms::owner_write));

    write_file(folder / "kept", "one");
    fs::permissions(folder / "kept", fs::perms::owner_read | fs::perms::others_read);
    fs::permissions(folder.path(), fs::perms::all);
    const int status = status_of([&] {
        constexpr uid_t kNobody = 65534;  // nothing is protected from root
        if (::geteuid() == 0 && ::setuid(kNobody) != 0) ::_exit(98);
        try {
            write_file(folder / "kept", "two");
        } catch (const IoError&) {
            ::_exit(7);
        }
    });
    CHECK(status == 7);
    CHECK(content(folder / "kept") == "one");
    CHECK(names_in(folder.path()) == std::set<std::string>{"mine", "kept"});
}

TEST_CASE("a device is written and stays one") {
    const TemporaryFolder folder;
    write_file("/dev/null", "nothing");
    CHECK(fs::is_character_file("/dev/null"));
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    std::string read;
    std::thread reader([&] { read = content(folder / "pipe"); });
    write_file(folder / "pipe", "all of it");
    reader.join();
    CHECK(read == "all of it");
    CHECK(names_in(folder.path()) == std::set<std::string>{"pipe"});
}

TEST_CASE("what killed processes left aside is removed, and nothing else") {
    const TemporaryFolder folder;
    const auto touch = [&](const fs::path& file) { std::ofstream(file) << "half"; };
    const pid_t dead = ::fork();
    if (dead == 0) ::_exit(0);
    ::waitpid(dead, nullptr, 0);
    const std::string number = std::to_string(dead);
    touch(folder / ("f_001.png." + number + "-0.part"));
    touch(name_aside(folder / "f_002.png"));  // this process is not writing it
    const std::set<std::string> others{"f_001.png",
                                       "g.png." + number + "-0.part",  // not asked for
                                       "f_001.png." + std::to_string(::getppid()) + "-0.part",  // lives
                                       "f_001.png.part",
                                       "f_001.png.x-0.part",
                                       "f_001.png.12345678901234567890123-0.part"};
    for (const std::string& name : others) touch(folder / name);
    remove_leftovers(folder.path(), [](const std::string& name) { return name.rfind("f_", 0) == 0; });
    CHECK(names_in(folder.path()) == others);
    remove_leftovers(folder / "gone", [](const std::string&) { return true; });
}

TEST_CASE("a request to end waits for the file that is being written, and is met at once otherwise") {
    CHECK(status_of([] { end_when_files_are_whole([] { ::_exit(5); }); }) == 5);
    CHECK(status_of([] {
              static bool is_whole = false;
              const auto end = [] { ::_exit(is_whole ? 6 : 1); };
              {
                  const UnbrokenWrite outer;
                  {
                      const UnbrokenWrite inner;
                      end_when_files_are_whole(end);
                  }
                  is_whole = true;
              }
          }) == 6);
    // Files begun on another thread meanwhile wait for the end.
    CHECK(status_of([] {
              std::thread writer([] {
                  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
                  while (std::chrono::steady_clock::now() < limit) const UnbrokenWrite whole;
                  ::_exit(1);
              });
              std::this_thread::sleep_for(std::chrono::milliseconds(2));
              end_when_files_are_whole([] { ::_exit(8); });
              writer.join();
          }) == 8);
}

TEST_CASE("at the end of the process, what takes too long is undone, unless it is over") {
    static int undone = 0;
    const auto undo = [](void* what) { undone += *static_cast<int*>(what); };
    const auto end = [] { ::_exit(undone); };
    CHECK(status_of([&] {
              int one = 1, two = 2, four = 4, eight = 8;
              const UndoneAtEnd first(undo, &one);
              { const UndoneAtEnd over(undo, &two); }
              const UndoneAtEnd third(undo, &four);
              { const UndoneAtEnd over(undo, &eight); }
              end_when_files_are_whole(end);
          }) == 5);
}
