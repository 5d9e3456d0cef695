#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <map>
#include <string>
#include <type_traits>

#include "morph/morph.h"
#include "render/figure/names.h"
#include "render/program/arguments.h"

/// Options that several subcommands have.
namespace automorph::program {

template <class E, std::size_t N>
std::map<std::string, E> choices(const std::array<Named<E>, N>& names) {
    std::map<std::string, E> map;
    for (const Named<E>& each : names) map[each.name] = each.value;
    return map;
}

/// "none|registration" instead of CLI11's list of numbers.
template <class E, std::size_t N>
std::string type_name(const std::array<Named<E>, N>& names) {
    std::string text;
    for (const Named<E>& each : names) text += (text.empty() ? "" : "|") + std::string(each.name);
    return text;
}

template <class E, std::size_t N>
CLI::Option* add_choice(CLI::App& command, const std::string& flag, E& value,
                        const std::array<Named<E>, N>& names, const std::string& meaning) {
    const std::string fallback = name_of(names, value);
    return command
        .add_option_function<std::string>(
            flag,
            [&value, flag, map = choices(names), allowed = type_name(names)](const std::string& text) {
                const auto found = map.find(text);
                if (found == map.end()) {
                    throw CLI::ValidationError(flag,
                                               fmt::format("found '{}', allowed are {}", text, allowed));
                }
                value = found->second;
            },
            meaning)
        ->type_name(type_name(names))
        ->default_str(fallback);
}

template <class T>
std::string short_number(T value) {
    if constexpr (std::is_floating_point_v<T>)
        return fmt::format("{:g}", value);
    else
        return fmt::format("{}", value);
}

/// As CLI::Range, with an error in the words of the others.
template <class T>
CLI::Validator range(T least, T most) {
    const CLI::Range inside(least, most);
    CLI::Validator validator = inside;
    validator.operation([inside, allowed = fmt::format("{} to {}", short_number(least), short_number(most))](
                            std::string& text) {
        if (inside(text).empty()) return std::string();
        return fmt::format("found '{}', allowed are {} from {}", text,
                           std::is_integral_v<T> ? "whole numbers" : "numbers", allowed);
    });
    return validator;
}

/// How a morph is made and moves.
void add_morph_options(CLI::App& command, MorphOptions& options, Interpolation& interpolation);

/// The subcommand `shape`, with one of its own per shape.
void add_shape(CLI::App& app, EllipsoidArguments& ellipsoid, StarArguments& star, HeadArguments& head);

/// The subcommand `turntable`.
void add_turntable(CLI::App& app, TurntableArguments& arguments);

}  // namespace automorph::program
