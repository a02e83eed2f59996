// SPDX-License-Identifier: Apache-2.0
#include "app/window/radiograph_texture.h"

#include <array>
#include <cstddef>

namespace kerf::window {

void RadiographTexture::show(const std::shared_ptr<const run::ViewedRadiograph>& radiograph) {
    if (radiograph == shown_) return;
    shown_ = radiograph;
    const auto is_whole = [](const run::ViewedRadiograph& one) {
        return one.error.empty() && one.columns > 0 && one.rows > 0 &&
               one.grey.size() == static_cast<std::size_t>(one.columns) * static_cast<std::size_t>(one.rows);
    };
    has_picture_ = radiograph != nullptr && is_whole(*radiograph);
    if (!has_picture_) return;
    if (texture_.get() == 0) texture_ = make_texture();
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    constexpr std::array<GLint, 4> grey{GL_RED, GL_RED, GL_RED, GL_ONE};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, grey.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, radiograph->columns, radiograph->rows, 0, GL_RED, GL_UNSIGNED_BYTE,
                 radiograph->grey.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace kerf::window
