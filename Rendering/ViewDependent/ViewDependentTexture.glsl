// Colours a rectangle over the image from the geometry of the surface. BLENDED_VIEWS must be defined.
in vec2 texCoord;
uniform sampler2DMS geometry;
uniform int geometrySamples;
uniform int viewCount;
uniform int viewOrder[64];      // by rising viewChords
uniform float viewChords[64];   // least angle, as a chord, to the novel camera anywhere on the surface
uniform vec4 viewRows[3 * 64];  // of K [R t], for positions relative to the origin
uniform vec4 viewCenters[64];   // centre of projection, focal length
uniform float disparityFactors[64]; // 1 - tolerance
uniform vec2 layerSize;         // texels
uniform vec4 novelCenter;       // of the renderer's camera, focal length in its pixels
uniform vec3 novelForward;      // unit vectors
uniform vec3 novelRight;
uniform vec3 novelUp;
uniform vec4 clipDepth;         // what gives the depth buffer's z and w
uniform vec4 clipScale;
uniform float feather;          // pixels
uniform vec3 unseenColor;
uniform float opacity;
uniform sampler2DArray photographs;
uniform sampler2DArray visibility; // disparity, confidence

vec3 unfoldedNormal(float folded)
{
  float steps = folded - 1.0;
  vec2 plane = vec2(floor(steps / 2048.0), mod(steps, 2048.0)) / 2047.0 * 2.0 - 1.0;
  float above = 1.0 - abs(plane.x) - abs(plane.y);
  vec2 sides = vec2(plane.x < 0.0 ? -1.0 : 1.0, plane.y < 0.0 ? -1.0 : 1.0);
  return normalize(vec3(above < 0.0 ? (1.0 - abs(plane.yx)) * sides : plane, above));
}

// How the position on the facet moves with a step of one pixel.
vec3 stepOnFacet(vec3 position, vec3 normal, vec3 direction)
{
  vec3 ray = position - novelCenter.xyz;
  float depth = dot(ray, novelForward);
  ray /= depth;
  float along = dot(normal, ray);
  vec3 sideways = direction / novelCenter.w;
  float steepness = abs(along) < 0.02 ? 50.0 * sign(along) : 1.0 / along;
  return depth * (sideways - ray * dot(normal, sideways) * steepness);
}

vec3 homogeneousPixel(int view, vec3 position)
{
  vec4 point = vec4(position, 1.0);
  return vec3(dot(viewRows[3 * view], point), dot(viewRows[3 * view + 1], point),
    dot(viewRows[3 * view + 2], point));
}

// What a view says about a point.
struct ViewSample
{
  float confidence; // 0 where the surface hides the point
  vec4 sides;       // beside an occlusion, the shares of the four texels that are on the point's side
  ivec3 corner;     // first of these texels
  bool masked;
};

// See VisibilityMap::At.
ViewSample sampleView(int view, vec3 pixel)
{
  ViewSample result = ViewSample(0.0, vec4(0.0), ivec3(0), false);
  vec2 texel = pixel.xy / pixel.z - 0.5;
  if (pixel.z <= 0.0 || any(lessThan(texel, vec2(0.0))) ||
    any(greaterThanEqual(texel, layerSize - 1.0)))
  {
    return result;
  }
  result.corner = ivec3(ivec2(texel), view);
  vec2 a = texelFetch(visibility, result.corner, 0).rg;
  vec2 b = texelFetch(visibility, result.corner + ivec3(1, 0, 0), 0).rg;
  vec2 c = texelFetch(visibility, result.corner + ivec3(0, 1, 0), 0).rg;
  vec2 d = texelFetch(visibility, result.corner + ivec3(1, 1, 0), 0).rg;
  vec2 part = fract(texel);
  vec4 parts = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y),
    (1.0 - part.x) * part.y, part.x * part.y);
  vec4 disparities = vec4(a.r, b.r, c.r, d.r) * pixel.z;
  vec4 confidences = vec4(a.g, b.g, c.g, d.g);
  float factor = disparityFactors[view];
  result.masked = min(min(a.g, b.g), min(c.g, d.g)) <= 0.00101;
  result.sides = parts * vec4(lessThanEqual(disparities * factor, vec4(1.0))) *
    vec4(greaterThanEqual(disparities, vec4(factor)));
  float hidden = dot(disparities, parts) * factor;
  result.confidence =
    result.masked ? dot(confidences, result.sides) : hidden > 1.0 ? 0.0 : dot(confidences, parts);
  return result;
}

// Beside an occlusion only the texels of the point's side count. Elsewhere the colour is filtered over
// the fragment, how the pixel moves with the position being known; but not beyond an occlusion, whose
// distance the confidence tells.
vec3 viewColor(int view, vec3 position, vec3 positionDx, vec3 positionDy)
{
  vec3 pixel = homogeneousPixel(view, position);
  ViewSample seen = sampleView(view, pixel);
  vec3 row0 = viewRows[3 * view].xyz;
  vec3 row1 = viewRows[3 * view + 1].xyz;
  vec3 row2 = viewRows[3 * view + 2].xyz;
  vec2 texel = pixel.xy / pixel.z;
  vec2 texelDx = (vec2(dot(row0, positionDx), dot(row1, positionDx)) -
    texel * dot(row2, positionDx)) / pixel.z;
  vec2 texelDy = (vec2(dot(row0, positionDy), dot(row1, positionDy)) -
    texel * dot(row2, positionDy)) / pixel.z;
  float reach = max(1.0, seen.confidence * feather * 0.5);
  float scale = min(1.0, reach / max(length(texelDx), length(texelDy)));
  vec3 filtered = textureGrad(photographs, vec3(texel / layerSize, float(view)),
    scale * texelDx / layerSize, scale * texelDy / layerSize).rgb;
  if (!seen.masked)
  {
    return filtered;
  }
  vec3 ofSide = seen.sides.x * texelFetch(photographs, seen.corner, 0).rgb +
    seen.sides.y * texelFetch(photographs, seen.corner + ivec3(1, 0, 0), 0).rgb +
    seen.sides.z * texelFetch(photographs, seen.corner + ivec3(0, 1, 0), 0).rgb +
    seen.sides.w * texelFetch(photographs, seen.corner + ivec3(1, 1, 0), 0).rgb;
  return ofSide / max(dot(seen.sides, vec4(1.0)), 1e-6);
}

vec3 viewDependentColor(vec3 position, vec3 normal)
{
  const float coarseness = 0.1; // what e-fold coarser pixels cost, beside the angle in radians
  const float leastPenalty = 0.005;
  vec3 toNovel = novelCenter.xyz - position;
  float novelDistance = length(toNovel);
  toNovel /= novelDistance;
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
    float confidence = sampleView(view, homogeneousPixel(view, position)).confidence;
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

  vec3 positionDx = stepOnFacet(position, normal, novelRight);
  vec3 positionDy = stepOnFacet(position, normal, novelUp);
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

void main()
{
  ivec2 pixel = ivec2(texCoord * vec2(textureSize(geometry)));
  vec4 first = vec4(0.0);
  float covered = 0.0;
  for (int i = 0; i < geometrySamples; ++i)
  {
    vec4 entry = texelFetch(geometry, pixel, i);
    first = covered == 0.0 && entry.w > 0.0 ? entry : first;
    covered += entry.w > 0.0 ? 1.0 : 0.0;
  }
  if (covered == 0.0)
  {
    discard;
  }
  // Only where an edge crosses the pixel are samples coloured one by one.
  vec3 normal = unfoldedNormal(first.w);
  float footprint = dot(first.xyz - novelCenter.xyz, novelForward) / novelCenter.w;
  bool edge = false;
  for (int i = 1; i < geometrySamples; ++i)
  {
    vec4 entry = texelFetch(geometry, pixel, i);
    edge = edge || (entry.w > 0.0 && length(entry.xyz - first.xyz) > 8.0 * footprint &&
      abs(dot(entry.xyz - first.xyz, normal)) > footprint);
  }
  vec3 sum = viewDependentColor(first.xyz, normal);
  float count = 1.0;
  for (int i = 0; i < (edge ? geometrySamples : 0); ++i)
  {
    vec4 entry = texelFetch(geometry, pixel, i);
    if (entry.w > 0.0 && entry.xyz != first.xyz)
    {
      sum += viewDependentColor(entry.xyz, unfoldedNormal(entry.w));
      count += 1.0;
    }
  }
  gl_FragData[0] = vec4(sum / count, opacity * covered / float(geometrySamples));
  vec4 point = vec4(first.xyz, 1.0);
  gl_FragDepth = dot(clipDepth, point) / dot(clipScale, point) * 0.5 + 0.5;
}
