// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/ray.hpp"
#include "etendue/raytracing/sample_key.hpp"
#include "etendue/scene/camera_frame.hpp"

namespace etendue {

/// Where in the picture: x' from its left edge, y' from its bottom edge, both as a share of the picture's size.
struct PicturePoint {
  double x = 0.5;
  double y = 0.5;
};

/// Point of a pixel in the picture.                                                                @eq IU.5.2
///
///     x' = (i + a) / R_x,   y' = (j + 1 − b) / R_y   with   j = R_y − 1 − row
///
/// Symbols   i = column and row as in Image, row 0 at the top; j, the sources' row, counts from the bottom;
///           a = across, b = down: share of the pixel's width from its left, of its height from its top edge; ½, ½ is
///           the centre, where y' = (j + ½) / R_y
/// Domain    column in [0, R_x), row in [0, R_y), across and down in [0, 1]
[[nodiscard]] PicturePoint picture_point(const Camera& camera, int column, int row, double across = 0.5,
                                         double down = 0.5);

/// The primary ray from the eye through a point of the picture.                                    @eq IU.5.2
///
///     P = S − E = d G + (2x' − 1) H + (2y' − 1) V,   H = d tan θ X,   V = d tan φ Y,   D = P / |P|
///
/// Symbols   E eye, S point of the view plane, d its distance from the eye (it cancels in D), X, Y, G the camera's
/// frame Returns   origin E, direction D, a unit vector to 2 ulp, over the open half-line t > 0
[[nodiscard]] Ray eye_ray(const CameraFrame& frame, const PicturePoint& point);

/// The ray of one sample through a thin lens, at a time while the shutter is open; eye_ray() for a pinhole and no exposure.
///
///     O = E + ρ (q_x X + q_y Y),   F = E + f P,   D = (F − O)/|F − O|,   time = τ w
///
/// Symbols   E, G, X, Y of eye_ray(), P its direction before it is made a unit vector, so F lies in the plane f before the eye; ρ
///           the lens's radius, f the focal distance, τ the shutter; q a point of the unit disc, √a (cos 2πb, sin 2πb); (a, b) in
///           the unit square and w in [0, 1] as the key spreads them over the samples of a pixel
/// Returns   what lies in the plane of F is sharp; a point at the distance z along the gaze is spread over a disc of radius
///           ρ |z − f|/f in the plane at z
[[nodiscard]] Ray sample_ray(const Camera& camera, const CameraFrame& frame, const PicturePoint& point,
                             const SampleKey& key);

/// The virtual screen: a rectangle [left, right] × [bottom, top] in the plane n = distance of the viewing frame
/// (u, v, n) = (X, Y, G) [length].
struct ViewWindow {
  double left, right;
  double bottom, top;
  double distance;
};

/// The window at `distance` that shows what the camera sees: ± d tan θ by ± d tan φ.
[[nodiscard]] ViewWindow view_window(const CameraFrame& frame, double distance);

/// The same primary ray, through the centre of virtual pixel (i, j), j from the bottom.               @eq RT.1, RT.2
///
///     u_s = l + (r − l)(i + ½)/n_x,   v_s = b + (t − b)(j + ½)/n_y,   n_s = ν;   r(t) = P_0 + t d,   d = P − P_0
///
/// Symbols   l, r, b, t the window's edges, ν its distance, n_x, n_y columns and rows, P_0 the eye
/// Returns   origin P_0; the direction is made a unit vector, so that t is a distance
[[nodiscard]] Ray window_ray(const CameraFrame& frame, const ViewWindow& window, const Camera& camera, int i, int j);

}  // namespace etendue
