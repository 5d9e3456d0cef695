#pragma once

#include <Eigen/Core>
#include <array>

#include "morph/mesh/mesh.h"
#include "morph/shapes/implicit.h"
#include "morph/shapes/shapes.h"

namespace automorph {

/// A human head: one neutral sculpture, carried to other proportions by a smooth deformation of space, so
/// that every point of one head has its exact counterpart on every other. Frame: x to the head's left, y up,
/// z forwards; the origin between the ears at the height of the pupils; symmetric about x = 0. The neutral
/// head is 1 high from chin to crown.
///
/// Proportions after Farkas, Anthropometry of the Head and Face (1994). Sizes are ratios to the neutral head;
/// the others are shifts in hundredths of the head's height, positive for more.
struct HeadParameters {
    // Sizes.
    double head_width = 1, head_length = 1;  ///< of the cranium, euryon to euryon and brow to occiput
    double head_height = 1;                  ///< eyes to crown
    double face_height = 1;                  ///< eyes to chin
    double face_width = 1;                   ///< between the cheekbones (bizygomatic)
    double jaw_width = 1;                    ///< between the angles of the jaw (bigonial)
    double eye_distance = 1;                 ///< between the pupils
    double eye_size = 1, eye_opening = 1;    ///< of the eye as a whole; height between the lids
    double nose_length = 1, nose_width = 1;  ///< nasion to subnasale; between the wings
    double mouth_width = 1, lip_fullness = 1;
    double ear_size = 1, neck_width = 1;
    // Shifts.
    double forehead = 0;         ///< its upper part forwards: less slope
    double brow_ridge = 0;       ///< forwards
    double eye_tilt = 0;         ///< outer corner upwards against the inner one
    double lid_fullness = 0;     ///< upper lid forwards and down over its crease, to the inner corner
    double nose_bridge = 0;      ///< its root forwards
    double nose_protrusion = 0;  ///< tip forwards
    double nose_tip = 0;         ///< tip upwards
    double cheekbones = 0;       ///< forwards and out
    double cheeks = 0;           ///< fullness between cheekbone and jaw
    double chin = 0;             ///< forwards
};

/// What each parameter is called and the range in which no head folds.
struct HeadParameter {
    const char* name;
    double HeadParameters::*member;
    double least, most;
    const char* meaning;
};
inline constexpr int kHeadParameterCount = 25;
extern const std::array<HeadParameter, kHeadParameterCount> kHeadParameters;

/// Averages and types. Asian and Caucasian follow the differences of group means in anthropometric surveys
/// (breadth of the face, height of the nose's root, width of the nose, fullness of the upper lid); every
/// group holds more variety than lies between them.
enum class HeadPreset { Neutral, Asian, Caucasian, Narrow, Broad, Child, Caricature };
HeadParameters head_parameters(HeadPreset preset);

/// The part of the head that is meshed.
enum class HeadCrop {
    Closed,  ///< head and neck, closed below
    Head,    ///< without the bottom of the neck: one border, in a plane of the neutral head
    Face,    ///< a mask in front of the ears, from the hair to under the chin: one border
};

struct HeadOptions {
    HeadParameters parameters;
    HeadCrop crop = HeadCrop::Closed;
    ShapeOptions shape;  ///< triangles: of what is kept, to a few in a hundred if cropped
};

/// Vertices lie on the surface to rounding; triangles are smaller at eyes, lips, nose and ears. The same
/// options give the same bits.
/// @throws InvalidMesh   a parameter out of its range, or not a number
/// @throws SolverFailure too few triangles for the features of a head
Mesh head(const HeadOptions& options = {});

/// The neutral head's surface.
ImplicitSurface head_surface();

/// Where the deformation takes a point of the neutral head's space. @throws InvalidMesh as head() does
Eigen::Vector3d deform_head(const HeadParameters& parameters, const Eigen::Vector3d& neutral);

/// Determinant of its derivative; positive everywhere: no fold.
double head_deformation_determinant(const HeadParameters& parameters, const Eigen::Vector3d& neutral);

/// The ground truth: points near the head of `from` and their counterparts on the head of `to` (both without
/// pose), to rounding.
/// @throws SolverFailure if a point is not in the image of the deformation
Points corresponding_head_points(const Points& points, const HeadParameters& from, const HeadParameters& to);

}  // namespace automorph
