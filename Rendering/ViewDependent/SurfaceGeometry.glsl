// Replaces the lighting of VTK when the geometry of the surface is drawn.
in vec3 surfacePosition;

// On the octahedron |x| + |y| + |z| = 1, whose lower half is folded outwards over the upper one.
float foldedNormal(vec3 normal)
{
  normal /= abs(normal.x) + abs(normal.y) + abs(normal.z);
  vec2 sides = vec2(normal.x < 0.0 ? -1.0 : 1.0, normal.y < 0.0 ? -1.0 : 1.0);
  vec2 folded = normal.z < 0.0 ? (1.0 - abs(normal.yx)) * sides : normal.xy;
  vec2 steps = floor((folded * 0.5 + 0.5) * 2047.0 + 0.5);
  return 1.0 + steps.x * 2048.0 + steps.y;
}
