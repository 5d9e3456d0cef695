// PLY (Turk 1994): a text header names elements and their properties; the data follow as text or binary.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "morph/mesh/binary_cursor.h"
#include "morph/mesh/readers.h"

namespace automorph {

namespace {

enum class Scalar { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

struct Property {
    std::string_view name;
    bool is_list = false;
    Scalar count_type = Scalar::UInt8;  ///< of lists
    Scalar type = Scalar::Float32;
};

struct Element {
    std::string_view name;
    std::int64_t count = 0;
    std::vector<Property> properties;

    std::size_t find(std::string_view property) const {
        std::size_t i = 0;
        while (i < properties.size() && properties[i].name != property) ++i;
        return i;
    }
};

enum class Encoding { Text, LittleEndian, BigEndian };

struct PlyHeader {
    Encoding encoding = Encoding::Text;
    std::vector<Element> elements;
    std::int64_t vertex_count = 0;
};

std::optional<Scalar> scalar_type(std::string_view name) {
    if (name == "char" || name == "int8") return Scalar::Int8;
    if (name == "uchar" || name == "uint8") return Scalar::UInt8;
    if (name == "short" || name == "int16") return Scalar::Int16;
    if (name == "ushort" || name == "uint16") return Scalar::UInt16;
    if (name == "int" || name == "int32") return Scalar::Int32;
    if (name == "uint" || name == "uint32") return Scalar::UInt32;
    if (name == "float" || name == "float32") return Scalar::Float32;
    if (name == "double" || name == "float64") return Scalar::Float64;
    return std::nullopt;
}

std::size_t size_of(Scalar type) {
    switch (type) {
        case Scalar::Int8:
        case Scalar::UInt8:
            return 1;
        case Scalar::Int16:
        case Scalar::UInt16:
            return 2;
        case Scalar::Float64:
            return 8;
        default:
            return 4;
    }
}

/// Values of a text body.
struct TextValues {
    TextCursor& in;
    static std::size_t smallest(Scalar) { return 2; }  // a digit and a blank
    std::size_t bytes_left() const { return in.bytes_left() + 1; }
    double next(Scalar, std::string_view what, std::int64_t index) {
        const std::string_view token = in.token();
        double value = 0.0;
        if (token.empty()) in.fail(fmt::format("the file ends within {} {}", what, index));
        if (!parse_number(token, value)) {
            in.fail(fmt::format("{} {}: expected a number, found {}", what, index, quoted(token)));
        }
        return value;
    }
    [[noreturn]] void fail(const std::string& message) const { in.fail(message); }
    bool at_end() { return in.at_end(); }
};

/// Values of a binary body.
struct BinaryValues {
    BinaryCursor in;
    static std::size_t smallest(Scalar type) { return size_of(type); }
    std::size_t bytes_left() const { return in.bytes_left(); }
    double next(Scalar type, std::string_view what, std::int64_t index) {
        switch (type) {
            case Scalar::Int8:
                return in.value<std::int8_t>(what, index);
            case Scalar::UInt8:
                return in.value<std::uint8_t>(what, index);
            case Scalar::Int16:
                return in.value<std::int16_t>(what, index);
            case Scalar::UInt16:
                return in.value<std::uint16_t>(what, index);
            case Scalar::Int32:
                return in.value<std::int32_t>(what, index);
            case Scalar::UInt32:
                return in.value<std::uint32_t>(what, index);
            case Scalar::Float32:
                return static_cast<double>(in.value<float>(what, index));
            case Scalar::Float64:
                break;
        }
        return in.value<double>(what, index);
    }
    [[noreturn]] void fail(const std::string& message) const { in.fail(message); }
    bool at_end() const { return in.rest().find_first_not_of(" \t\r\n") == std::string_view::npos; }
};

Property parse_property(TextCursor& in) {
    Property property;
    const auto type = [&] {
        const std::string_view name = in.token_on_line();
        const auto found = scalar_type(name);
        if (!found) in.fail(fmt::format("expected a type such as float or int, found {}", quoted(name)));
        return *found;
    };
    TextCursor ahead = in;
    if (ahead.token_on_line() == "list") {
        in = ahead;
        property.is_list = true;
        property.count_type = type();
        if (property.count_type == Scalar::Float32 || property.count_type == Scalar::Float64) {
            in.fail("a list length must be an integer type");
        }
    }
    property.type = type();
    property.name = in.token_on_line();
    if (property.name.empty()) in.fail("a property without a name");
    return property;
}

Element parse_element(TextCursor& in) {
    Element element;
    element.name = in.token_on_line();
    const std::string_view count = in.token_on_line();
    if (!parse_integer(count, element.count) || element.count < 0) {
        in.fail(fmt::format("element {}: expected how many there are, found {}", quoted(element.name),
                            quoted(count)));
    }
    return element;
}

Encoding parse_encoding(TextCursor& in) {
    const std::string_view word = in.token_on_line();
    if (word == "ascii") return Encoding::Text;
    if (word == "binary_little_endian") return Encoding::LittleEndian;
    if (word == "binary_big_endian") return Encoding::BigEndian;
    in.fail(fmt::format("expected ascii, binary_little_endian or binary_big_endian, found {}", quoted(word)));
}

/// Leaves the cursor at the first byte after the header.
PlyHeader parse_header(TextCursor& in) {
    PlyHeader header;
    if (in.token() != "ply") in.fail("a PLY file starts with the word 'ply'");
    bool has_format = false, has_vertices = false;
    for (;;) {
        const std::string_view word = in.token();
        if (word.empty()) in.fail("the file ends within the header, before 'end_header'");
        if (word == "format") {
            header.encoding = parse_encoding(in);
            has_format = true;
        } else if (word == "element") {
            Element element = parse_element(in);
            if (element.name == "vertex") {
                if (has_vertices) in.fail("a second element 'vertex'");
                has_vertices = true;
                header.vertex_count = element.count;
            }
            header.elements.push_back(std::move(element));
        } else if (word == "property") {
            if (header.elements.empty()) in.fail("a property before the first element");
            header.elements.back().properties.push_back(parse_property(in));
        } else if (word == "end_header") {
            break;
        } else if (word != "comment" && word != "obj_info") {
            in.fail(fmt::format("expected a header line such as 'element vertex 8', found {}", quoted(word)));
        }
        in.skip_line();
    }
    if (!has_format) in.fail("the header has no 'format' line");
    if (!has_vertices) in.fail("the header has no element 'vertex'");
    in.skip_line();
    return header;
}

template <class Values>
void check_count(const Values& values, const Element& element) {
    std::size_t bytes = 0;
    for (const Property& p : element.properties) bytes += Values::smallest(p.is_list ? p.count_type : p.type);
    if (bytes > 0 && static_cast<std::uint64_t>(element.count) > values.bytes_left() / bytes) {
        values.fail(
            fmt::format("the header announces {} entries of element {}, more than the {} bytes that follow "
                        "can hold",
                        element.count, quoted(element.name), values.bytes_left()));
    }
}

template <class Values>
std::int64_t list_length(Values& values, const Property& p, std::string_view what, std::int64_t index) {
    const double length = values.next(p.count_type, what, index);
    if (!(length >= 0.0 && length == std::floor(length) &&
          length <= static_cast<double>(values.bytes_left() / Values::smallest(p.type)))) {
        values.fail(fmt::format("{} {}: a list of {} values, more than the bytes that follow can hold", what,
                                index, length));
    }
    return static_cast<std::int64_t>(length);
}

template <class Values>
void skip_property(Values& values, const Property& p, std::string_view what, std::int64_t index) {
    const std::int64_t n = p.is_list ? list_length(values, p, what, index) : 1;
    for (std::int64_t k = 0; k < n; ++k) values.next(p.type, what, index);
}

template <class Values>
void read_vertices(Values& values, const Element& element, SoupBuilder& soup) {
    const std::size_t at[3] = {element.find("x"), element.find("y"), element.find("z")};
    for (const std::size_t i : at) {
        if (i == element.properties.size() || element.properties[i].is_list) {
            values.fail("element 'vertex' lacks one of the properties x, y, z");
        }
    }
    if (element.count > std::numeric_limits<int>::max()) values.fail("more vertices than an int can count");
    // With three properties check_count has bounded the number by the file's size.
    soup.reserve(static_cast<std::size_t>(element.count), 0, 0);
    for (std::int64_t v = 0; v < element.count; ++v) {
        double xyz[3] = {0, 0, 0};
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const Property& p = element.properties[i];
            if (i != at[0] && i != at[1] && i != at[2]) {
                skip_property(values, p, "vertex", v);
                continue;
            }
            const double value = values.next(p.type, "vertex", v);
            if (!(std::abs(value) <= kLargestCoordinate)) {
                values.fail(
                    fmt::format("{} of vertex {}: expected a finite coordinate, found {}", p.name, v, value));
            }
            for (int k = 0; k < 3; ++k) {
                if (i == at[k]) xyz[k] = value;
            }
        }
        soup.add_vertex(xyz[0], xyz[1], xyz[2]);
    }
}

template <class Values>
void read_faces(Values& values, const Element& element, std::int64_t vertex_count, SoupBuilder& soup) {
    std::size_t indices = element.find("vertex_indices");
    if (indices == element.properties.size()) indices = element.find("vertex_index");
    if (indices == element.properties.size() || !element.properties[indices].is_list) {
        values.fail("element 'face' lacks the list property vertex_indices (or vertex_index)");
    }
    for (std::int64_t f = 0; f < element.count; ++f) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const Property& p = element.properties[i];
            if (i != indices) {
                skip_property(values, p, "face", f);
                continue;
            }
            const std::int64_t corners = list_length(values, p, "face", f);
            for (std::int64_t k = 0; k < corners; ++k) {
                const double vertex = values.next(p.type, "face", f);
                if (!(vertex >= 0.0 && vertex < static_cast<double>(vertex_count) &&
                      vertex == std::floor(vertex))) {
                    values.fail(fmt::format("face {} uses vertex {}, but the file has vertices 0 to {}", f,
                                            vertex, vertex_count - 1));
                }
                soup.add_corner(static_cast<int>(vertex));
            }
            soup.end_polygon();
        }
    }
}

template <class Values>
PolygonSoup read_body(Values values, const PlyHeader& header) {
    SoupBuilder soup;
    bool has_faces = false;
    for (const Element& element : header.elements) {
        check_count(values, element);
        if (element.name == "vertex") {
            read_vertices(values, element, soup);
        } else if (element.name == "face" && element.count > 0) {
            if (has_faces) values.fail("a second element 'face'");
            has_faces = true;
            read_faces(values, element, header.vertex_count, soup);
        } else if (!element.properties.empty()) {
            for (std::int64_t i = 0; i < element.count; ++i) {
                for (const Property& p : element.properties) skip_property(values, p, element.name, i);
            }
        }
    }
    if (!values.at_end()) values.fail("data follow the last element that the header announces");
    return soup.finish();
}

}  // namespace

bool looks_like_ply(std::string_view bytes) {
    return bytes.size() > 3 && bytes.starts_with("ply") &&
           (bytes[3] == '\n' || bytes[3] == '\r' || bytes[3] == ' ');
}

PolygonSoup read_ply(const FileBytes& file) {
    TextCursor in(file, {});
    const PlyHeader header = parse_header(in);
    if (header.encoding == Encoding::Text) return read_body(TextValues{in}, header);
    std::size_t offset = file.bytes.size() - in.bytes_left();
    // Where lines end with CR alone, a body that begins with the byte LF must keep it.
    if (file.bytes[3] == '\r' && file.bytes[4] != '\n' && file.bytes[offset - 1] == '\n') --offset;
    const auto order = header.encoding == Encoding::LittleEndian ? std::endian::little : std::endian::big;
    return read_body(BinaryValues{BinaryCursor(file, offset, order)}, header);
}

}  // namespace automorph
