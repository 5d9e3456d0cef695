#include "render/image/canvas.h"

#include <cairo.h>

#include <array>
#include <cassert>
#include <cstdint>

#include "render/image/image_file.h"

namespace automorph::render {

namespace {

// Cairo draws each pixel as so many squared, and their mean is taken: versions of Cairo cover pixels at edges
// differently, and where thousands of edges meet that is seen.
constexpr int kFine = 4;

}  // namespace

struct Canvas::State {
    cairo_surface_t* surface;
    cairo_t* cairo;

    State(int width, int height)
        : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, kFine * width, kFine * height)),
          cairo(cairo_create(surface)) {
        cairo_scale(cairo, kFine, kFine);
        cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        cairo_destroy(cairo);
        cairo_surface_destroy(surface);
    }

    void use(const Color& color, double opacity) const {
        const auto code = [&](int channel) { return to_srgb8(color[channel]) / 255.0; };
        cairo_set_source_rgba(cairo, code(0), code(1), code(2), opacity);
    }

    void trace(const std::vector<Eigen::Vector2d>& points) const {
        cairo_new_path(cairo);
        for (const Eigen::Vector2d& p : points) cairo_line_to(cairo, p.x(), p.y());
    }

    /// Outlines the path and forgets it.
    void stroke(const Pen& pen) const {
        if (pen.width > 0.0) {
            use(pen.color, pen.opacity);
            cairo_set_line_width(cairo, pen.width);
            cairo_stroke(cairo);
        }
        cairo_new_path(cairo);
    }

    /// Fills the path and outlines it.
    void paint(const Color& fill, const Pen& outline) const {
        use(fill, 1.0);
        cairo_fill_preserve(cairo);
        stroke(outline);
    }

    int width() const { return cairo_image_surface_get_width(surface) / kFine; }
    int height() const { return cairo_image_surface_get_height(surface) / kFine; }

    /// Visits the parts of pixel (x, y) as Cairo keeps them, 0x00RRGGBB.
    template <typename Visit>
    void each_part(int x, int y, const Visit& visit) const {
        unsigned char* data = cairo_image_surface_get_data(surface);
        for (int j = kFine * y; j < kFine * (y + 1); ++j) {
            auto* row = reinterpret_cast<std::uint32_t*>(data + j * cairo_image_surface_get_stride(surface));
            for (int i = kFine * x; i < kFine * (x + 1); ++i) visit(row[i]);
        }
    }
};

Canvas::Canvas(const Image& background)
    : state_(std::make_unique<State>(background.width, background.height)) {
    assert(background.channels == 3 && background.width > 0 && background.height > 0);
    cairo_surface_flush(state_->surface);
    for (int y = 0; y < background.height; ++y) {
        for (int x = 0; x < background.width; ++x) {
            const float* color = background.at(x, y);
            const auto code = static_cast<std::uint32_t>(to_srgb8(color[0]) << 16 | to_srgb8(color[1]) << 8 |
                                                         to_srgb8(color[2]));
            state_->each_part(x, y, [code](std::uint32_t& part) { part = code; });
        }
    }
    cairo_surface_mark_dirty(state_->surface);
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Pen& pen) {
    polyline({from, to}, pen);
}

void Canvas::polyline(const std::vector<Eigen::Vector2d>& points, const Pen& pen) {
    state_->trace(points);
    state_->stroke(pen);
}

void Canvas::polygon(const std::vector<Eigen::Vector2d>& points, const Color& fill, const Pen& outline) {
    state_->trace(points);
    cairo_close_path(state_->cairo);
    state_->paint(fill, outline);
}

void Canvas::dot(const Eigen::Vector2d& center, double radius, const Color& fill, const Pen& outline) {
    constexpr double kFullTurn = 6.283185307179586;
    cairo_new_path(state_->cairo);
    cairo_arc(state_->cairo, center.x(), center.y(), radius, 0.0, kFullTurn);
    state_->paint(fill, outline);
}

Image Canvas::image() const {
    cairo_surface_flush(state_->surface);
    Image image(state_->width(), state_->height());
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            std::array<std::uint32_t, 3> sum{};
            state_->each_part(x, y, [&](std::uint32_t part) {
                for (std::size_t channel = 0; channel < 3; ++channel)
                    sum[channel] += part >> (16 - 8 * channel) & 0xffu;
            });
            for (std::size_t channel = 0; channel < 3; ++channel)
                image.at(x, y)[channel] = from_srgb(sum[channel] / (255.0 * kFine * kFine));
        }
    }
    return image;
}

}  // namespace automorph::render
