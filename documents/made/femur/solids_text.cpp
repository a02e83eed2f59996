// SPDX-License-Identifier: Apache-2.0
#include "documents/made/femur/solids_text.h"

namespace kerf::documents {
namespace {

std::string between(const char* kind, Vec3 from, Vec3 to) {
    return std::string(kind) + ": {from: " + vector_text(from) + " mm, to: " + vector_text(to) + " mm, ";
}

}  // namespace

std::string tube_text(Vec3 from, Vec3 to, double radius) {
    return between("tube", from, to) + "radius: " + rounded_text(radius) + " mm}";
}

std::string elliptic_tube_text(Vec3 from, Vec3 to, double width, double height, const std::string& up) {
    return between("elliptic_tube", from, to) + "width: " + rounded_text(width) +
           " mm, height: " + rounded_text(height) + " mm, up: " + up + "}";
}

std::string sphere_text(Vec3 centre, double radius) {
    return "sphere: {centre: " + vector_text(centre) + " mm, radius: " + rounded_text(radius) + " mm}";
}

std::string solid_part(const char* id, const std::string& solid, const WrittenJoint& joint) {
    std::string text = std::string("    - id: ") + id + "\n      " + solid + "\n";
    if (joint.subtract) text += "      subtract: true\n";
    if (joint.blend > 0.0) text += "      blend: " + rounded_text(joint.blend) + " mm\n";
    if (joint.mirror) text += "      mirror: true\n";
    if (!joint.source.empty()) text += folded("source", joint.source, 6);
    return text;
}

std::string axis_text(const char* id, Vec3 from, Vec3 to, double tolerance) {
    return std::string("    ") + id + ": {from: " + vector_text(from) + " mm, to: " + vector_text(to) +
           " mm, tolerance: " + rounded_text(tolerance) + " mm}\n";
}

}  // namespace kerf::documents
