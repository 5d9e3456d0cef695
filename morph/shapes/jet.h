#pragma once

#include <cmath>

namespace automorph {

/// A value with its gradient in space: forward-mode automatic differentiation. A formula written once for a
/// scalar type gives its value with double and its gradient with Jet.
struct Jet {
    double value = 0.0;
    double x = 0.0, y = 0.0, z = 0.0;  ///< derivatives

    Jet() = default;
    Jet(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): a constant is a Jet
    Jet(double v, double dx, double dy, double dz) : value(v), x(dx), y(dy), z(dz) {}

    /// f(v) whose derivative at v is slope.
    Jet chain(double f, double slope) const { return {f, slope * x, slope * y, slope * z}; }

    Jet operator-() const { return {-value, -x, -y, -z}; }
    friend Jet operator+(const Jet& a, const Jet& b) {
        return {a.value + b.value, a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend Jet operator-(const Jet& a, const Jet& b) {
        return {a.value - b.value, a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend Jet operator*(const Jet& a, const Jet& b) {
        return {a.value * b.value, a.value * b.x + b.value * a.x, a.value * b.y + b.value * a.y,
                a.value * b.z + b.value * a.z};
    }
    friend Jet operator+(const Jet& a, double b) { return {a.value + b, a.x, a.y, a.z}; }
    friend Jet operator+(double a, const Jet& b) { return b + a; }
    friend Jet operator-(const Jet& a, double b) { return {a.value - b, a.x, a.y, a.z}; }
    friend Jet operator-(double a, const Jet& b) { return {a - b.value, -b.x, -b.y, -b.z}; }
    friend Jet operator*(const Jet& a, double b) { return {a.value * b, a.x * b, a.y * b, a.z * b}; }
    friend Jet operator*(double a, const Jet& b) { return b * a; }
    friend Jet operator/(const Jet& a, double b) { return a * (1.0 / b); }
    friend Jet operator/(const Jet& a, const Jet& b) {
        const double inverse = 1.0 / b.value, quotient = a.value * inverse;
        return {quotient, (a.x - quotient * b.x) * inverse, (a.y - quotient * b.y) * inverse,
                (a.z - quotient * b.z) * inverse};
    }
    friend Jet sqrt(const Jet& a) {
        const double root = std::sqrt(a.value);
        return a.chain(root, 0.5 / root);
    }
};

inline double value_of(double a) {
    return a;
}
inline double value_of(const Jet& a) {
    return a.value;
}

}  // namespace automorph
