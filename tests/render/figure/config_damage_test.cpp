// Damaged configs: whatever the text, the parser gives a config or one line of error with its place.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/figure/config.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

struct Outcome {
    int configs = 0, errors = 0;
};

void try_text(const std::string& text, Outcome& outcome) {
    try {
        parse_config(text, "damaged.yaml");
        ++outcome.configs;
    } catch (const ConfigError& error) {
        ++outcome.errors;
        const std::string message = error.what();
        INFO(message);
        REQUIRE(message.rfind("damaged.yaml:", 0) == 0);
        REQUIRE(message.find('\n') == std::string::npos);
        REQUIRE(message.size() < 2000);
    }
}

std::vector<std::string> shipped() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(AUTOMORPH_CONFIGS)) {
        if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<std::string> texts;
    for (const auto& file : files) {
        std::ifstream in(file);
        texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return texts;
}

std::string damaged(std::string text, std::mt19937& random) {
    const auto below = [&](std::size_t n) {
        return static_cast<std::size_t>(random()) % std::max<std::size_t>(n, 1);
    };
    static const char* const kWords[] = {"nan",
                                         ".inf",
                                         "1e300",
                                         "-1",
                                         "99999999999999999999",
                                         "\"\"",
                                         "[",
                                         "]",
                                         "{",
                                         "}",
                                         "- ",
                                         ": ",
                                         "&a ",
                                         "*a ",
                                         "<<: ",
                                         "!!binary ",
                                         "\t",
                                         "\xe7\xbd\x91",
                                         "\xff",
                                         "|\n",
                                         "null",
                                         "~",
                                         "? ",
                                         "---\n",
                                         "%YAML 9.9\n",
                                         "#"};
    const std::size_t place = below(text.size());
    switch (below(7)) {
        case 0:
            return text.substr(0, place);
        case 1:
            if (!text.empty()) text[place] = static_cast<char>(text[place] ^ (1 << below(8)));
            return text;
        case 2:
            return text.substr(0, place) + kWords[below(std::size(kWords))] + text.substr(place);
        case 3: {  // in place of a value
            const std::size_t colon = text.find(": ", place), end = text.find('\n', colon);
            if (colon == std::string::npos || end == std::string::npos) return text;
            return text.replace(colon + 2, end - colon - 2, kWords[below(std::size(kWords))]);
        }
        case 4:
            return text.erase(place, 1 + below(30));
        case 5:
            return text.insert(place, text.substr(below(text.size()), below(80)));
        default: {
            std::string crlf;
            for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
            return crlf;
        }
    }
}

}  // namespace

TEST_CASE("thousands of damaged configs give a config or one line with its place") {
    const std::vector<std::string> originals = shipped();
    REQUIRE(originals.size() > 3);
    std::mt19937 random(2004);
    Outcome outcome;
    for (int round = 0; round < 4000; ++round) {
        std::string text = originals[random() % originals.size()];
        for (unsigned repeat = 0; repeat <= random() % 3; ++repeat) text = damaged(text, random);
        INFO("round " << round << "\n" << text);
        try_text(text, outcome);
    }
    CHECK(outcome.errors > 1000);
    CHECK(outcome.configs > 300);
}

TEST_CASE("configs that nest or repeat beyond measure are refused") {
    Outcome outcome;
    for (const char* open : {"[", "{a: ", "- ", "? ", "!a "}) {
        std::string deep;
        for (int k = 0; k < 20000; ++k) deep += open;
        try_text(deep, outcome);
    }
    std::string laughs = "a0: &a0 [x, x]\n";
    for (int k = 1; k < 40; ++k) {
        const std::string before = fmt::format("*a{}", k - 1);
        laughs += fmt::format("a{}: &a{} [{}, {}]\n", k, k, before, before);
    }
    try_text(laughs, outcome);
    try_text(std::string(100000, 'x'), outcome);
    try_text("", outcome);
    CHECK(outcome.errors == 8);
}
