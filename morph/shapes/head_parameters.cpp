#include "morph/shapes/head.h"

namespace automorph {

namespace {
using P = HeadParameters;
}

const std::array<HeadParameter, kHeadParameterCount> kHeadParameters{{
    {"head_width", &P::head_width, 0.8, 1.25, "width of the cranium, ratio to the neutral head"},
    {"head_length", &P::head_length, 0.8, 1.25, "length of the cranium, likewise a ratio"},
    {"head_height", &P::head_height, 0.75, 1.3, "eyes to crown, ratio"},
    {"face_height", &P::face_height, 0.75, 1.3, "eyes to chin, ratio"},
    {"face_width", &P::face_width, 0.85, 1.2, "between the cheekbones, ratio"},
    {"jaw_width", &P::jaw_width, 0.8, 1.25, "between the angles of the jaw, ratio"},
    {"eye_distance", &P::eye_distance, 0.9, 1.12, "between the pupils, ratio"},
    {"eye_size", &P::eye_size, 0.8, 1.25, "of the whole eye, ratio"},
    {"eye_opening", &P::eye_opening, 0.75, 1.2, "height between the lids, ratio"},
    {"nose_length", &P::nose_length, 0.8, 1.25, "root to base, ratio"},
    {"nose_width", &P::nose_width, 0.75, 1.35, "between the wings, ratio"},
    {"mouth_width", &P::mouth_width, 0.8, 1.25, "between the corners, ratio"},
    {"lip_fullness", &P::lip_fullness, 0.7, 1.4, "height and thickness of the lips, ratio"},
    {"ear_size", &P::ear_size, 0.7, 1.4, "height of the ears, ratio"},
    {"neck_width", &P::neck_width, 0.75, 1.2, "width of the neck, ratio"},
    {"forehead", &P::forehead, -3, 3, "upper part forwards, hundredths of the head's height"},
    {"brow_ridge", &P::brow_ridge, -2, 2, "forwards, hundredths"},
    {"eye_tilt", &P::eye_tilt, -1.5, 1.5, "outer corner up against the inner one, hundredths"},
    {"lid_fullness", &P::lid_fullness, -0.5, 1, "upper lid forwards and down over its crease, hundredths"},
    {"nose_bridge", &P::nose_bridge, -3, 2, "root of the nose forwards, hundredths"},
    {"nose_protrusion", &P::nose_protrusion, -3, 4, "tip forwards, hundredths"},
    {"nose_tip", &P::nose_tip, -2, 2, "tip up, hundredths"},
    {"cheekbones", &P::cheekbones, -2, 2.5, "forwards and out, hundredths"},
    {"cheeks", &P::cheeks, -2.5, 3, "fullness between cheekbone and jaw, hundredths"},
    {"chin", &P::chin, -3, 4, "forwards, hundredths"},
}};

HeadParameters head_parameters(HeadPreset preset) {
    HeadParameters h;
    switch (preset) {
        case HeadPreset::Neutral:
            break;
        case HeadPreset::Asian:
            h.head_width = 1.04;
            h.head_length = 0.95;
            h.face_width = 1.05;
            h.jaw_width = 1.03;
            h.eye_opening = 0.82;
            h.eye_tilt = 0.6;
            h.lid_fullness = 0.9;
            h.brow_ridge = -1.0;
            h.nose_bridge = -2.0;
            h.nose_protrusion = -1.0;
            h.nose_width = 1.12;
            h.nose_length = 0.96;
            h.cheekbones = 1.0;
            h.lip_fullness = 1.08;
            h.chin = -0.6;
            break;
        case HeadPreset::Caucasian:
            h.head_length = 1.03;
            h.face_width = 0.97;
            h.brow_ridge = 0.5;
            h.nose_bridge = 1.0;
            h.nose_protrusion = 0.8;
            h.nose_width = 0.93;
            h.nose_length = 1.04;
            h.cheekbones = -0.5;
            h.lip_fullness = 0.92;
            h.chin = 0.5;
            break;
        case HeadPreset::Narrow:
            h.head_width = 0.92;
            h.face_width = 0.94;
            h.jaw_width = 0.92;
            h.face_height = 1.08;
            h.nose_length = 1.08;
            h.nose_width = 0.9;
            h.mouth_width = 0.95;
            h.neck_width = 0.9;
            h.cheeks = -1.2;
            break;
        case HeadPreset::Broad:
            h.head_width = 1.07;
            h.face_width = 1.06;
            h.jaw_width = 1.13;
            h.face_height = 0.94;
            h.nose_width = 1.12;
            h.mouth_width = 1.07;
            h.neck_width = 1.12;
            h.cheeks = 1.2;
            break;
        case HeadPreset::Child:
            h.head_height = 1.1;
            h.face_height = 0.84;
            h.jaw_width = 0.9;
            h.forehead = 1.5;
            h.brow_ridge = -1.6;
            h.eye_size = 1.16;
            h.eye_opening = 1.06;
            h.nose_bridge = -1.6;
            h.nose_protrusion = -1.8;
            h.nose_length = 0.9;
            h.nose_tip = 0.9;
            h.mouth_width = 0.9;
            h.lip_fullness = 1.05;
            h.cheeks = 1.0;
            h.chin = -0.8;
            h.neck_width = 0.86;
            break;
        case HeadPreset::Caricature:
            h.head_height = 0.88;
            h.face_height = 1.12;
            h.jaw_width = 1.1;
            h.brow_ridge = 1.2;
            h.nose_protrusion = 3.0;
            h.nose_length = 1.12;
            h.nose_width = 1.2;
            h.nose_tip = -0.8;
            h.ear_size = 1.3;
            h.mouth_width = 1.12;
            h.lip_fullness = 1.15;
            h.cheekbones = 1.2;
            h.cheeks = -1.5;
            h.chin = 3.0;
            h.neck_width = 0.85;
            break;
    }
    return h;
}

}  // namespace automorph
