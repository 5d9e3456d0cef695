#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/files.h"

/// The program in a process of its own.
class Process {
public:
    /// @param largest_file  bytes; 0: no limit. A limit stands for a full disk
    Process(const std::filesystem::path& folder, const std::string& arguments, rlim_t largest_file = 0) {
        std::vector<std::string> words{AUTOMORPH_PROGRAM};
        std::istringstream stream(arguments);
        for (std::string word; stream >> word;) words.push_back(word);
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        const std::string out = logs_ / "out", err = logs_ / "err";
        process_ = ::fork();
        if (process_ != 0) return;
        for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
        if (::chdir(folder.c_str()) != 0) ::_exit(98);
        ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
        ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
        ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        if (largest_file > 0) {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit limit{largest_file, largest_file};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        }
        ::execv(pointers.front(), pointers.data());
        ::_exit(97);
    }
    ~Process() {
        if (is_running()) ::kill(process_, SIGKILL);
        wait();
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) { ::kill(process_, signal); }
    /// False if it ends before.
    bool wait_until_it_catches(int signal) {
        while (is_running()) {
            // Before exec, the handlers are still those of the test.
            const std::filesystem::path own = std::filesystem::path("/proc") / std::to_string(process_);
            std::error_code error;
            if (!std::filesystem::equivalent(own / "exe", AUTOMORPH_PROGRAM, error)) continue;
            std::ifstream status(own / "status");
            for (std::string word; status >> word;) {
                if (word != "SigCgt:" || !(status >> word)) continue;
                if ((std::stoull(word, nullptr, 16) >> (signal - 1) & 1) != 0) return true;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }
    bool is_running() {
        if (!is_over_) is_over_ = ::waitpid(process_, &status_, WNOHANG) == process_;
        return !is_over_;
    }
    /// Exit status; 1000 + signal if a signal ended it.
    int wait() {
        if (!is_over_) ::waitpid(process_, &status_, 0);
        is_over_ = true;
        return WIFEXITED(status_) ? WEXITSTATUS(status_) : 1000 + WTERMSIG(status_);
    }
    std::string out() const { return content(logs_ / "out"); }
    std::string err() const { return content(logs_ / "err"); }

private:
    TemporaryFolder logs_;
    pid_t process_ = 0;
    int status_ = 0;
    bool is_over_ = false;
};
