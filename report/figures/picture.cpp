// Casts one ray for each pixel of a raster finer than the picture, spheres nearest to the eye first.
#include "report/figures/picture.h"

#include "engine/base/error.h"
#include "engine/base/vec.h"
#include "report/figures/makers.h"
#include "report/figures/style.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace tamp {

namespace {

/// Rays across a pixel: edges come out smooth.
constexpr std::size_t kFine = 2;

constexpr std::array<float, 3> kPaper = {1, 1, 1};

using Colour = std::array<float, 3>;

/// A sphere or disc with its colour.
template <int D>
struct Ball {
  Vec<D> centre;
  double radius;
  Colour colour;
};

/// All spheres, and those images of them that reach into a periodic box through a face.
template <int D>
std::vector<Ball<D>> balls_of(const Packing& packing, const ColourScale& scale) {
  std::vector<Ball<D>> balls;
  balls.reserve(packing.count());
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const double r = packing.radii[i];
    Colour colour{};
    const auto exact = palette_colour(scale.share(r));
    for (std::size_t k = 0; k < 3; ++k)
      colour[k] = static_cast<float>(exact[k]);
    const std::size_t first = balls.size();
    balls.push_back({packing.centre<D>(i), r, colour});
    for (int axis = 0; axis < D; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (packing.boundary[a] != Boundary::periodic)
        continue;
      const std::size_t end = balls.size();
      for (std::size_t k = first; k < end; ++k) {
        for (const int shift : {-1, 1}) {
          Ball<D> image = balls[k];
          image.centre[axis] += shift * packing.size[a];
          if (image.centre[axis] > -r && image.centre[axis] < packing.size[a] + r)
            balls.push_back(image);
        }
      }
    }
  }
  return balls;
}

/// The box; an open axis ends where its last sphere does.
template <int D>
Vec<D> box_of(const Packing& packing) {
  Vec<D> box;
  for (int axis = 0; axis < D; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    box[axis] = packing.size[a];
    if (packing.boundary[a] == Boundary::open) {
      box[axis] = 0;
      for (std::size_t i = 0; i < packing.count(); ++i)
        box[axis] = std::max(box[axis], packing.centre<D>(i)[axis] + packing.radii[i]);
    }
  }
  return box;
}

/// The fine raster: a colour and a depth for each ray. Rows count from below.
struct Raster {
  std::size_t width;
  std::size_t height;
  double step; ///< from ray to ray
  std::vector<Colour> colours;
  std::vector<float> depths;

  Raster(double wide, double high, std::size_t pixels) {
    const double pixel = std::max(wide, high) / static_cast<double>(pixels);
    const auto fit = [&](double length) {
      return std::clamp(static_cast<std::size_t>(std::lround(length / pixel)), std::size_t{1}, pixels) * kFine;
    };
    step = pixel / static_cast<double>(kFine);
    width = fit(wide);
    height = fit(high);
    colours.assign(width * height, kPaper);
    depths.assign(width * height, std::numeric_limits<float>::infinity());
  }

  /// Calls f(ray, distance²) for the rays closer than r to a place.
  template <class F>
  void rays_around(double x, double y, double r, F&& f) const {
    const auto range = [&](double at, std::size_t n) {
      const double low = std::ceil((at - r) / step - 0.5);
      const double high = std::floor((at + r) / step - 0.5);
      const auto last = static_cast<double>(n) - 1;
      return std::pair(static_cast<std::ptrdiff_t>(std::max(low, 0.0)),
                       static_cast<std::ptrdiff_t>(std::min(high, last)));
    };
    const auto [x0, x1] = range(x, width);
    const auto [y0, y1] = range(y, height);
    for (std::ptrdiff_t j = y0; j <= y1; ++j) {
      for (std::ptrdiff_t i = x0; i <= x1; ++i) {
        const double dx = (static_cast<double>(i) + 0.5) * step - x;
        const double dy = (static_cast<double>(j) + 0.5) * step - y;
        const double squared = dx * dx + dy * dy;
        if (squared < r * r)
          f(static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i), squared);
      }
    }
  }

  [[nodiscard]] Picture picture() const {
    Picture picture;
    picture.width = width / kFine;
    picture.height = height / kFine;
    picture.pixel = step * static_cast<double>(kFine);
    picture.rgb.reserve(3 * picture.width * picture.height);
    for (std::size_t row = picture.height; row-- > 0;) {
      for (std::size_t column = 0; column < picture.width; ++column) {
        for (std::size_t k = 0; k < 3; ++k) {
          float sum = 0;
          for (std::size_t j = 0; j < kFine; ++j) {
            for (std::size_t i = 0; i < kFine; ++i)
              sum += colours[(row * kFine + j) * width + column * kFine + i][k];
          }
          picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * sum / (kFine * kFine))));
        }
      }
    }
    return picture;
  }
};

Picture draw_discs(const Packing& packing, const ColourScale& scale, std::size_t pixels) {
  const Vec<2> box = box_of<2>(packing);
  Raster raster(box[0], box[1], pixels);
  for (const Ball<2>& disc : balls_of<2>(packing, scale)) {
    raster.rays_around(disc.centre[0], disc.centre[1], disc.radius,
                       [&](std::size_t ray, double) { raster.colours[ray] = disc.colour; });
  }
  return raster.picture();
}

/// Where a ray is inside a box, and the faces' normals where it goes in and out; empty if enter >= leave.
struct Span {
  double enter;
  double leave;
  Vec<3> normal_in;
  Vec<3> normal_out;
};

Span span_in_box(const Vec<3>& start, const Vec<3>& direction, const Vec<3>& low, const Vec<3>& high) {
  Span span{-HUGE_VAL, HUGE_VAL, Vec<3>::Zero(), Vec<3>::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - start[axis]) / direction[axis];
    const double b = (high[axis] - start[axis]) / direction[axis];
    const double sign = direction[axis] > 0 ? -1 : 1; // the face that is met first looks back at the eye
    if (std::min(a, b) > span.enter) {
      span.enter = std::min(a, b);
      span.normal_in = sign * Vec<3>::Unit(axis);
    }
    if (std::max(a, b) < span.leave) {
      span.leave = std::max(a, b);
      span.normal_out = sign * Vec<3>::Unit(axis); // of what lies behind, so it looks back, too
    }
  }
  return span;
}

/// The eye: directions to the right, up and away from it, none along an axis of the box.
struct View {
  Vec<3> away = -Vec<3>(1.0, -1.3, 0.95).normalized();
  Vec<3> right = away.cross(Vec<3>::UnitZ()).normalized();
  Vec<3> up = right.cross(away);
  Vec<3> light = (-0.75 * away + 0.55 * up - 0.35 * right).normalized();
  /// A cut face is a little paler than the sphere, so that it is told from it.
  [[nodiscard]] Colour shaded(const Colour& colour, const Vec<3>& normal, bool cut) const {
    const auto light_share = static_cast<float>(0.35 + 0.65 * std::max(0.0, normal.dot(light)));
    Colour out{};
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = std::min(1.0F, cut ? 0.8F * (0.25F + 0.75F * light_share) * colour[k] + 0.2F : light_share * colour[k]);
    return out;
  }
};

/// The box, the octant that is cut away, and where the raster lies before them.
class Scenery {
public:
  Scenery(const Vec<3>& box, std::size_t pixels)
      : box_(box), low_(box[0] / 2, 0, box[2] / 2), high_(box[0], box[1] / 2, box[2]), raster_(frame(pixels)) {}

  void draw(const Ball<3>& ball) {
    const Vec<3> centre = ball.centre - origin_;
    const double depth = centre.dot(view_.away);
    raster_.rays_around(centre.dot(view_.right), centre.dot(view_.up), ball.radius,
                        [&](std::size_t ray, double squared) {
                          const double half = std::sqrt(ball.radius * ball.radius - squared);
                          if (static_cast<double>(raster_.depths[ray]) > depth - half)
                            cast(ray, ball, depth - half, depth + half);
                        });
  }

  [[nodiscard]] const View& view() const { return view_; }
  [[nodiscard]] Picture picture() const { return raster_.picture(); }

private:
  /// What a ray that is inside the ball from `enter` to `leave` sees of it.
  void cast(std::size_t ray, const Ball<3>& ball, double enter, double leave) {
    const std::size_t column = ray % raster_.width;
    const std::size_t row = ray / raster_.width;
    const Vec<3> start = origin_ + (static_cast<double>(column) + 0.5) * raster_.step * view_.right +
                         (static_cast<double>(row) + 0.5) * raster_.step * view_.up;
    const Span box = span_in_box(start, view_.away, Vec<3>::Zero(), box_);
    const Span octant = span_in_box(start, view_.away, low_, high_);
    Vec<3> normal = (start + enter * view_.away - ball.centre) / ball.radius;
    bool cut = false;
    if (box.enter > enter) {
      enter = box.enter;
      normal = box.normal_in;
      cut = true;
    }
    if (octant.enter < octant.leave && enter >= octant.enter && enter < octant.leave) {
      enter = octant.leave;
      normal = octant.normal_out;
      cut = true;
    }
    if (enter >= std::min(leave, box.leave) || enter >= static_cast<double>(raster_.depths[ray]))
      return;
    raster_.depths[ray] = static_cast<float>(enter);
    raster_.colours[ray] = view_.shaded(ball.colour, normal, cut);
  }

  /// A raster that shows the whole box.
  Raster frame(std::size_t pixels) {
    Vec<3> low = Vec<3>::Constant(HUGE_VAL);
    Vec<3> high = -low;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec<3> at(corner & 1 ? box_[0] : 0, corner & 2 ? box_[1] : 0, corner & 4 ? box_[2] : 0);
      const Vec<3> seen(at.dot(view_.right), at.dot(view_.up), at.dot(view_.away));
      low = low.cwiseMin(seen);
      high = high.cwiseMax(seen);
    }
    origin_ = low[0] * view_.right + low[1] * view_.up + low[2] * view_.away;
    return {high[0] - low[0], high[1] - low[1], pixels};
  }

  View view_;
  Vec<3> box_;
  Vec<3> low_; ///< corners of the octant towards the eye
  Vec<3> high_;
  Vec<3> origin_ = Vec<3>::Zero();
  Raster raster_;
};

Picture draw_spheres(const Packing& packing, const ColourScale& scale, std::size_t pixels) {
  const std::vector<Ball<3>> balls = balls_of<3>(packing, scale);
  Scenery scenery(box_of<3>(packing), pixels);
  std::vector<std::size_t> order(balls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Vec<3> away = scenery.view().away;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return balls[a].centre.dot(away) - balls[a].radius < balls[b].centre.dot(away) - balls[b].radius;
  });
  for (const std::size_t i : order)
    scenery.draw(balls[i]);
  return scenery.picture();
}

} // namespace

double ColourScale::share(double radius) const {
  return logarithmic ? std::log(radius / low) / std::log(high / low) : (radius - low) / (high - low);
}

ColourScale colour_scale(const Packing& packing) {
  const auto [low, high] = std::minmax_element(packing.radii.begin(), packing.radii.end());
  if (*high <= *low * 1.02) // equal spheres: the middle of the palette
    return {0.9 * *low, 1.1 * *high, false};
  return {*low, *high, *high > kLogRatio * *low};
}

std::string Picture::ppm() const {
  std::string out = fmt::format("P6\n{} {}\n255\n", width, height);
  out.append(rgb.begin(), rgb.end());
  return out;
}

std::size_t Picture::ppm_header() const {
  return ppm().size() - rgb.size();
}

Picture draw_packing(const Packing& packing, const ColourScale& scale, std::size_t pixels) {
  if (packing.count() == 0)
    throw InputError("a packing without spheres cannot be drawn");
  return packing.dimension == 2 ? draw_discs(packing, scale, pixels) : draw_spheres(packing, scale, pixels);
}

} // namespace tamp
