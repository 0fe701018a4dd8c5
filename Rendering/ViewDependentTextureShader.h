// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewDependentTextureShader_h
#define freespace_ViewDependentTextureShader_h

namespace freespace
{

constexpr int ShaderMaximumViews = 64;

/// What vtkViewDependentTextureMapper adds to VTK's fragment shader, see that class. Positions are
/// in the unit of the surface, relative to an origin near it. One layer of the texture arrays
/// belongs to each view; its first texel is the photograph's top left pixel.
constexpr const char* ViewDependentTextureShader = R"(
in vec3 surfacePosition;
uniform int viewCount;
uniform int viewOrder[64];      // by rising viewChords
uniform float viewChords[64];   // least angle, as a chord, to the novel camera anywhere on the surface
uniform vec4 viewRows[3 * 64];  // of K [R t], for positions relative to the origin
uniform vec4 viewCenters[64];   // centre of projection, focal length
uniform vec2 layerSize;         // texels
uniform vec4 novelCenter;       // of the renderer's camera, focal length in its pixels
uniform float disparityFactor;  // 1 - tolerance
uniform vec3 unseenColor;
uniform sampler2DArray photographs;
uniform sampler2DArray visibility; // disparity, confidence

vec3 homogeneousPixel(int view, vec3 position)
{
  vec4 point = vec4(position, 1.0);
  return vec3(dot(viewRows[3 * view], point), dot(viewRows[3 * view + 1], point),
    dot(viewRows[3 * view + 2], point));
}

// Confidence in a view, 0 where the surface hides the point from it.
float viewConfidence(int view, vec3 pixel)
{
  vec2 texel = pixel.xy / pixel.z;
  if (pixel.z <= 0.0 || any(lessThan(texel, vec2(0.5))) || any(greaterThan(texel, layerSize)))
  {
    return 0.0;
  }
  vec2 seen = textureLod(visibility, vec3(texel / layerSize, float(view)), 0.0).rg;
  return 1.0 < pixel.z * seen.r * disparityFactor ? 0.0 : seen.g;
}

// Colour of a view, filtered over the fragment: how the pixel moves with the position is known.
vec3 viewColor(int view, vec3 position, vec3 positionDx, vec3 positionDy)
{
  vec3 pixel = homogeneousPixel(view, position);
  vec3 row0 = viewRows[3 * view].xyz;
  vec3 row1 = viewRows[3 * view + 1].xyz;
  vec3 row2 = viewRows[3 * view + 2].xyz;
  vec2 texel = pixel.xy / pixel.z;
  vec2 texelDx = (vec2(dot(row0, positionDx), dot(row1, positionDx)) -
    texel * dot(row2, positionDx)) / pixel.z;
  vec2 texelDy = (vec2(dot(row0, positionDy), dot(row1, positionDy)) -
    texel * dot(row2, positionDy)) / pixel.z;
  return textureGrad(photographs, vec3(texel / layerSize, float(view)), texelDx / layerSize,
    texelDy / layerSize).rgb;
}

vec3 viewDependentColor(vec3 position, vec3 positionDx, vec3 positionDy)
{
  const float coarseness = 0.1; // what e-fold coarser pixels cost, beside the angle in radians
  const float leastPenalty = 0.005;
  vec3 toNovel = novelCenter.xyz - position;
  float novelDistance = length(toNovel);
  toNovel /= novelDistance;
  vec3 normal = cross(positionDx, positionDy);
  float novelSide = dot(normal, toNovel);

  // The least penalties in rising order, one more than are blended.
  float penalties[BLENDED_VIEWS + 1];
  int views[BLENDED_VIEWS + 1];
  for (int i = 0; i <= BLENDED_VIEWS; ++i)
  {
    penalties[i] = 1e20;
    views[i] = -1;
  }
  float greatest = 1e20;
  for (int rank = 0; rank < viewCount; ++rank)
  {
    if (viewChords[rank] >= greatest)
    {
      break; // neither this view nor a later one can be among the best
    }
    int view = viewOrder[rank];
    vec3 toView = viewCenters[view].xyz - position;
    float viewDistance = length(toView);
    float chord = length(toNovel - toView / viewDistance);
    if (chord >= greatest || dot(normal, toView) * novelSide <= 0.0)
    {
      continue; // confidence can only make it worse
    }
    float confidence = viewConfidence(view, homogeneousPixel(view, position));
    if (confidence <= 0.0)
    {
      continue;
    }
    float coarser = viewDistance * novelCenter.w / (novelDistance * viewCenters[view].w);
    float penalty =
      (chord + coarseness * max(0.0, log(coarser)) + leastPenalty) / confidence;
    int entry = view;
    for (int i = 0; i <= BLENDED_VIEWS; ++i)
    {
      if (penalty < penalties[i])
      {
        float otherPenalty = penalties[i];
        int otherView = views[i];
        penalties[i] = penalty;
        views[i] = entry;
        penalty = otherPenalty;
        entry = otherView;
      }
    }
    greatest = penalties[BLENDED_VIEWS];
  }

  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < BLENDED_VIEWS; ++i)
  {
    if (views[i] >= 0)
    {
      float weight = max(1.0 / penalties[i] - 1.0 / penalties[BLENDED_VIEWS], 1e-6);
      sum += weight * viewColor(views[i], position, positionDx, positionDy);
      weights += weight;
    }
  }
  return weights > 0.0 ? sum / weights : unseenColor;
}
)";

}

#endif
