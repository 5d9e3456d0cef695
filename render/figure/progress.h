#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>

namespace automorph {

/// Called while something takes time: what is being done, the finished fraction in [0, 1] or kUnknown and,
/// where there is more to tell, a detail such as "frame 3 of 96, 4.1 M rays/s". A task begins with its first
/// call and ends with the call at 1. Never called from two threads at once. An empty one tells nobody.
class Progress {
public:
    static constexpr double kUnknown = -1.0;  ///< a fraction that nobody knows

    Progress() = default;

    /// From whatever takes (task, fraction) or (task, fraction, detail).
    template <class Listener, class = std::enable_if_t<!std::is_same_v<std::decay_t<Listener>, Progress>>>
    Progress(Listener listener) {
        if constexpr (std::is_invocable_v<Listener&, const std::string&, double, const std::string&>) {
            tell_ = std::move(listener);
        } else {
            tell_ = [listener = std::move(listener)](const std::string& task, double fraction,
                                                     const std::string&) mutable {
                listener(task, fraction);
            };
        }
    }

    explicit operator bool() const { return static_cast<bool>(tell_); }

    void operator()(const std::string& task, double fraction, const std::string& detail = {}) const {
        if (tell_) tell_(task, fraction, detail);
    }

private:
    std::function<void(const std::string& task, double fraction, const std::string& detail)> tell_;
};

}  // namespace automorph
