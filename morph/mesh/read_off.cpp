// OFF as Geomview defines it: [ST][C][N]OFF, counts, vertices, faces; text or binary.
#include <fmt/format.h>

#include <limits>

#include "morph/mesh/binary_cursor.h"
#include "morph/mesh/readers.h"

namespace automorph {

namespace {

constexpr TextRules kOffText{'#', false};

struct OffHeader {
    bool valid = false;        ///< the keyword is one of OFF's
    bool spatial = true;       ///< false: 4OFF or nOFF
    int extra_per_vertex = 0;  ///< numbers after x y z: normal 3, colour 4, texture 2
};

OffHeader parse_keyword(std::string_view word) {
    OffHeader header;
    if (word == "off" || word == "Off") word = "OFF";
    while (word.size() > 3) {
        if (word.starts_with("ST")) {
            header.extra_per_vertex += 2;
            word.remove_prefix(1);
        } else if (word[0] == 'C') {
            header.extra_per_vertex += 4;
        } else if (word[0] == 'N') {
            header.extra_per_vertex += 3;
        } else if (word[0] == '4' || word[0] == 'n') {
            header.spatial = false;
        } else {
            return header;
        }
        word.remove_prefix(1);
    }
    header.valid = word == "OFF";
    return header;
}

/// Lines that hold more than blanks and comments, counted up to `enough`.
std::int64_t data_lines(std::string_view text, std::int64_t enough) {
    std::int64_t lines = 0;
    bool in_comment = false, has_data = false;
    for (const char c : text) {
        if (c == '\n' || c == '\r') {
            lines += has_data ? 1 : 0;
            if (lines >= enough) return lines;
            in_comment = has_data = false;
        } else if (c == '#') {
            in_comment = true;
        } else if (!in_comment && c != ' ' && c != '\t') {
            has_data = true;
        }
    }
    return lines + (has_data ? 1 : 0);
}

struct Counts {
    std::int64_t vertices = 0, faces = 0;
};

template <class Cursor>
void check_counts(const Cursor& in, const Counts& counts, std::size_t vertex_bytes, std::size_t face_bytes) {
    const auto check = [&](std::int64_t count, std::size_t bytes, const char* what) {
        if (count < 0) in.fail(fmt::format("the header announces {} {}", count, what));
        if (count > std::numeric_limits<int>::max() ||
            static_cast<std::size_t>(count) > (in.bytes_left() + 1) / bytes) {
            in.fail(fmt::format("the header announces {} {}, more than the {} bytes that follow can hold",
                                count, what, in.bytes_left()));
        }
    };
    check(counts.vertices, vertex_bytes, "vertices");
    check(counts.faces, face_bytes, "faces");
}

Counts text_counts(TextCursor& in) {
    Counts counts;
    counts.vertices = in.integer("the number of vertices", -1);
    const int line = in.line();
    counts.faces = in.integer("the number of faces", -1);
    // The number of edges is often left out; it means nothing to us.
    if (in.line() == line) {
        const std::string_view edges = in.token_on_line();
        double ignored = 0.0;
        if (!edges.empty() && !parse_number(edges, ignored)) {
            in.fail(fmt::format("expected the number of edges, found {}", quoted(edges)));
        }
    } else {
        in.integer("the number of edges", -1);
    }
    check_counts(in, counts, 6, 2);
    return counts;
}

PolygonSoup read_text(TextCursor& in, const OffHeader& header) {
    const Counts counts = text_counts(in);
    SoupBuilder soup;
    soup.reserve(static_cast<std::size_t>(counts.vertices), static_cast<std::size_t>(counts.faces), 0);
    // Geomview ignores line ends, but most files have a line per vertex, and colours of three or four numbers
    // that the keyword may or may not announce. Where there are lines enough, what follows z is skipped.
    TextCursor ahead = in;
    ahead.at_end();
    int on_first_line = 0;
    while (on_first_line < 3 && !ahead.token_on_line().empty()) ++on_first_line;
    const std::int64_t lines = counts.vertices + counts.faces;
    const bool line_per_vertex = on_first_line == 3 && data_lines(in.rest(), lines) >= lines;
    for (std::int64_t v = 0; v < counts.vertices; ++v) {
        const double x = in.coordinate("x of vertex", v), y = in.coordinate("y of vertex", v),
                     z = in.coordinate("z of vertex", v);
        soup.add_vertex(x, y, z);
        if (line_per_vertex) {
            in.skip_line();
        } else {
            for (int k = 0; k < header.extra_per_vertex; ++k) in.token();
        }
    }
    const bool line_per_face = data_lines(in.rest(), counts.faces) >= counts.faces;
    for (std::int64_t f = 0; f < counts.faces; ++f) {
        const std::int64_t corners = in.integer("the number of corners of face", f);
        if (corners < 0 || static_cast<std::size_t>(corners) > in.bytes_left() / 2 + 1) {
            in.fail(fmt::format("face {} announces {} corners", f, corners));
        }
        for (std::int64_t k = 0; k < corners; ++k) {
            const std::int64_t vertex = in.integer("a vertex index of face", f);
            if (vertex < 0 || vertex >= counts.vertices) {
                in.fail(fmt::format("face {} uses vertex {}, but the file has vertices 0 to {}", f, vertex,
                                    counts.vertices - 1));
            }
            soup.add_corner(static_cast<int>(vertex));
        }
        soup.end_polygon();
        if (line_per_face) in.skip_line();  // a colour
    }
    if (!in.at_end()) {
        const std::string_view more = in.token();
        in.fail(fmt::format("the header announces {} faces, but more data follow: {}; correct the count",
                            counts.faces, quoted(more)));
    }
    return soup.finish();
}

PolygonSoup read_binary(BinaryCursor in, const OffHeader& header) {
    Counts counts;
    counts.vertices = in.value<std::int32_t>("the number of vertices in the header, line", 1);
    counts.faces = in.value<std::int32_t>("the number of faces in the header, line", 1);
    in.value<std::int32_t>("the number of edges in the header, line", 1);
    check_counts(in, counts, 12 + 4 * static_cast<std::size_t>(header.extra_per_vertex), 8);
    SoupBuilder soup;
    soup.reserve(static_cast<std::size_t>(counts.vertices), static_cast<std::size_t>(counts.faces), 0);
    for (std::int64_t v = 0; v < counts.vertices; ++v) {
        const double x = in.coordinate<float>("x of vertex", v), y = in.coordinate<float>("y of vertex", v),
                     z = in.coordinate<float>("z of vertex", v);
        soup.add_vertex(x, y, z);
        for (int k = 0; k < header.extra_per_vertex; ++k) in.value<float>("vertex", v);
    }
    for (std::int64_t f = 0; f < counts.faces; ++f) {
        const auto corners = in.value<std::int32_t>("face", f);
        if (corners < 0 || static_cast<std::size_t>(corners) > in.bytes_left() / 4) {
            in.fail(fmt::format("face {} announces {} corners", f, corners));
        }
        for (int k = 0; k < corners; ++k) {
            const auto vertex = in.value<std::int32_t>("face", f);
            if (vertex < 0 || vertex >= counts.vertices) {
                in.fail(fmt::format("face {} uses vertex {}, but the file has vertices 0 to {}", f, vertex,
                                    counts.vertices - 1));
            }
            soup.add_corner(vertex);
        }
        soup.end_polygon();
        const auto colours = in.value<std::int32_t>("face", f);
        if (colours < 0 || static_cast<std::size_t>(colours) > in.bytes_left() / 4) {
            in.fail(fmt::format("face {} announces {} colour components", f, colours));
        }
        in.skip(4 * static_cast<std::size_t>(colours));
    }
    return soup.finish();
}

}  // namespace

bool looks_like_off(std::string_view bytes) {
    const FileBytes file{bytes.substr(0, 4096), {}};
    TextCursor in(file, kOffText);
    return parse_keyword(in.token()).valid;
}

PolygonSoup read_off(const FileBytes& file) {
    TextCursor in(file, kOffText);
    TextCursor ahead = in;
    const std::string_view word = ahead.token();
    double number = 0.0;
    if (word.empty())
        in.fail("the file holds no data; an OFF file starts with the word OFF and three counts");
    if (parse_number(word, number)) return read_text(in, {});  // the keyword may be missing
    const OffHeader header = parse_keyword(word);
    if (!header.valid) {
        ahead.fail(fmt::format("expected the word OFF (or COFF, NOFF, STOFF, ...), found {}", quoted(word)));
    }
    if (!header.spatial) {
        ahead.fail(
            fmt::format("{} has points of other than three dimensions; convert it to OFF", quoted(word)));
    }
    in = ahead;
    if (ahead.token_on_line() == "BINARY") {
        ahead.skip_line();
        return read_binary(BinaryCursor(file, file.bytes.size() - ahead.bytes_left(), std::endian::big),
                           header);
    }
    return read_text(in, header);
}

}  // namespace automorph
