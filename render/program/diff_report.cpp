#include "render/program/diff_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace automorph::program {
namespace {

using render::Place;
using render::TestResult;

const char* status_name(DiffStatus status) {
    switch (status) {
        case DiffStatus::Same:
            return "same";
        case DiffStatus::Different:
            return "different";
        case DiffStatus::CannotCompare:
            break;
    }
    return "cannot compare";
}

std::size_t count(const std::vector<PictureDiff>& diffs, DiffStatus status) {
    return static_cast<std::size_t>(std::count_if(
        diffs.begin(), diffs.end(), [&](const PictureDiff& diff) { return diff.status == status; }));
}

std::string range(const char* axis, int first, int extent) {
    return extent == 1 ? fmt::format("{} {}", axis, first)
                       : fmt::format("{} {}-{}", axis, first, first + extent - 1);
}

/// Of the place of a test.
/// @param channels  of the picture
std::string channel_name(const TestResult& test, const std::vector<std::string>& channels) {
    const std::vector<std::string>& names = test.channels.empty() ? channels : test.channels;
    const auto channel = static_cast<std::size_t>(test.where.channel);
    return channel < names.size() ? names[channel] : "?";
}

/// "x 16-23, y 40-47, blue"
std::string place_text(const TestResult& test, const std::vector<std::string>& channels) {
    const Place& place = test.where;
    if (place.width == 0) return "";
    return fmt::format("{}, {}, {}", range("x", place.x, place.width), range("y", place.y, place.height),
                       channel_name(test, channels));
}

/// "+2.1 %", or in radiance where the golden is black; "0.5 to nan" where no number tells the change.
std::string change_text(const TestResult& test) {
    const double change = test.found - test.golden;
    if (!std::isfinite(change)) return fmt::format("{:.3g} to {:.3g}", test.golden, test.found);
    if (std::abs(change) <= 1e-3 * std::abs(test.golden)) return fmt::format("{:+.2g}", change);
    if (!(std::abs(change) < 10.0 * std::abs(test.golden))) return fmt::format("{:+.3g}", change);
    return fmt::format("{:+.1f} %", 100.0 * change / test.golden);
}

/// Counts in full, measures to four digits.
std::string value_text(double value) {
    const bool is_count = std::abs(value) < 1e9 && std::floor(value) == value;
    return is_count ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

/// "blocks 8 x 8 at x 16-23, y 40-47, blue: 12.3, limit 5.1, +10.1 %"
std::string finding_text(const PictureDiff& diff) {
    const TestResult& test = diff.comparison.worst();
    const std::string text =
        fmt::format("{} {} (limit {})", test.name, value_text(test.value), value_text(test.limit));
    if (test.where.width == 0) return text;
    return fmt::format("{} at {}: {}", text, place_text(test, diff.channels), change_text(test));
}

std::string how_text(const PictureDiff& diff, const DiffArguments& arguments) {
    if (diff.mode != DiffMode::Statistical) return name_of(kDiffModes, diff.mode);
    return fmt::format("statistical, false alarms at most {:.3g} %",
                       100.0 * arguments.statistical.false_alarm_rate);
}

std::string tests_table(const PictureDiff& diff) {
    std::string text = fmt::format("\n{:<20} {:>10} {:>10}  {:<32} {:>10} {:>10}  {:<10}{}\n", "test",
                                   "value", "limit", "largest at", "golden", "new", "change",
                                   diff.mode == DiffMode::Statistical ? "by noise" : "");
    for (const TestResult& test : diff.comparison.tests) {
        const std::string chance = test.chance ? fmt::format("{:.2g}", *test.chance) : "";
        text += fmt::format("{:<20} {:>10} {:>10}  {:<32} {:>10.4g} {:>10.4g}  {:<10}{}{}\n", test.name,
                            value_text(test.value), value_text(test.limit), place_text(test, diff.channels),
                            test.golden, test.found, change_text(test), chance,
                            test.passed() ? "" : "  DIFFERENT");
    }
    if (diff.sensitivity) {
        text += fmt::format(
            "seen would have been: {:.2g} % more or less of all light, {:.2g} of radiance in 3 x 3 pixels "
            "(standard error {:.2g}, new {:.2g})\n",
            100.0 * diff.sensitivity->even_change, diff.sensitivity->local_change,
            diff.sensitivity->golden_error, diff.sensitivity->found_error);
    }
    return text;
}

nlohmann::ordered_json test_json(const TestResult& test, const std::vector<std::string>& channels) {
    nlohmann::ordered_json json{{"name", test.name},   {"passed", test.passed()}, {"value", test.value},
                                {"limit", test.limit}, {"where", nullptr},        {"golden", test.golden},
                                {"new", test.found}};
    if (test.where.width > 0) {
        json["where"] = {{"x", test.where.x},
                         {"y", test.where.y},
                         {"width", test.where.width},
                         {"height", test.where.height},
                         {"channel", channel_name(test, channels)}};
    }
    if (test.chance) json["chance"] = *test.chance;
    return json;
}

nlohmann::ordered_json picture_json(const PictureDiff& diff) {
    nlohmann::ordered_json json{{"name", diff.name}, {"verdict", status_name(diff.status)}};
    if (diff.status == DiffStatus::CannotCompare) {
        json["reason"] = diff.reason;
        return json;
    }
    json["mode"] = name_of(kDiffModes, diff.mode);
    json["tests"] = nlohmann::ordered_json::array();
    for (const TestResult& test : diff.comparison.tests)
        json["tests"].push_back(test_json(test, diff.channels));
    if (diff.sensitivity) {
        json["sensitivity"] = {
            {"even_change", diff.sensitivity->even_change},
            {"local_change", diff.sensitivity->local_change},
            {"standard_error",
             {{"golden", diff.sensitivity->golden_error}, {"new", diff.sensitivity->found_error}}}};
    }
    return json;
}

}  // namespace

DiffStatus status_of(const std::vector<PictureDiff>& diffs) {
    for (const DiffStatus status : {DiffStatus::CannotCompare, DiffStatus::Different}) {
        if (count(diffs, status) > 0) return status;
    }
    return DiffStatus::Same;
}

std::string diff_verdict(const std::vector<PictureDiff>& diffs, const DiffArguments& arguments) {
    const std::size_t different = count(diffs, DiffStatus::Different),
                      impossible = count(diffs, DiffStatus::CannotCompare);
    if (diffs.size() == 1) {
        const PictureDiff& diff = diffs.front();
        if (impossible > 0) return fmt::format("CANNOT COMPARE {}\n", diff.name);
        if (different > 0)
            return fmt::format("DIFFERENT ({}): {}\n", how_text(diff, arguments), finding_text(diff));
        return fmt::format("same ({}): {}\n", how_text(diff, arguments), diff.name);
    }
    std::string text = impossible > 0 ? "CANNOT COMPARE" : different > 0 ? "DIFFERENT" : "same";
    text +=
        fmt::format(": of {} pictures {} {} the same", diffs.size(), diffs.size() - different - impossible,
                    diffs.size() - different - impossible == 1 ? "is" : "are");
    if (different > 0) text += fmt::format(", {} differ{}", different, different == 1 ? "s" : "");
    if (impossible > 0) text += fmt::format(", {} cannot be compared", impossible);
    const bool statistical = std::any_of(diffs.begin(), diffs.end(), [](const PictureDiff& diff) {
        return diff.mode == DiffMode::Statistical;
    });
    if (statistical)
        text +=
            fmt::format(" (false alarms at most {:.3g} %)", 100.0 * arguments.statistical.false_alarm_rate);
    return text + "\n";
}

std::string diff_table(const std::vector<PictureDiff>& diffs) {
    if (diffs.size() == 1)
        return diffs.front().status == DiffStatus::CannotCompare ? "" : tests_table(diffs.front());
    std::size_t width = 7;
    for (const PictureDiff& diff : diffs) width = std::max(width, diff.name.size());
    std::string text =
        fmt::format("\n{:<{}}  {:<14}  {:<11}  {}\n", "picture", width, "verdict", "mode", "worst test");
    for (const PictureDiff& diff : diffs) {
        const bool compared = diff.status != DiffStatus::CannotCompare;
        text +=
            fmt::format("{:<{}}  {:<14}  {:<11}  {}\n", diff.name, width, status_name(diff.status),
                        compared ? name_of(kDiffModes, diff.mode) : "-", compared ? finding_text(diff) : "-");
    }
    return text;
}

std::string diff_json(const std::vector<PictureDiff>& diffs, const DiffArguments& arguments) {
    nlohmann::ordered_json json{{"verdict", status_name(status_of(diffs))},
                                {"status", static_cast<int>(status_of(diffs))},
                                {"golden", arguments.golden.string()},
                                {"new", arguments.found.string()},
                                {"false_alarm_rate", arguments.statistical.false_alarm_rate},
                                {"same", count(diffs, DiffStatus::Same)},
                                {"different", count(diffs, DiffStatus::Different)},
                                {"not_compared", count(diffs, DiffStatus::CannotCompare)},
                                {"pictures", nlohmann::ordered_json::array()}};
    for (const PictureDiff& diff : diffs) json["pictures"].push_back(picture_json(diff));
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace automorph::program
