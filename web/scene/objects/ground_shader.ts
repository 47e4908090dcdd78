// Shaders of the ground: two sets of grid lines, each as wide on the screen everywhere and fading where it gets dense.
// Colours are as on the screen, not linear. Distances along the ground are found at vertices, which are near enough to each other: software renderers are slow.

export const groundVertex = `
varying vec2 vLocal;
varying vec2 vMetres;
varying float vAway;
uniform float radius, tilt;
void main() {
  vLocal = position.xy;
  vMetres = position.xy;
  if (radius > 0.0) {
    float outward = radius + position.z;
    float pole = position.y * cos(tilt) + outward * sin(tilt);
    float equator = outward * cos(tilt) - position.y * sin(tilt);
    vMetres = radius * vec2(atan(position.x, equator), asin(clamp(pole / radius, -1.0, 1.0)));
  }
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vAway = length(view.xyz);
  gl_Position = projectionMatrix * view;
}`;

export const groundFragment = `
precision highp float;
varying vec2 vLocal;
varying vec2 vMetres;
varying float vAway;
uniform float spacing, fine, shade;
uniform vec2 offset;
uniform vec3 base, haze, line, shadow;

float lines(vec2 count, vec2 pixel) {
  vec2 away = abs(fract(count) - 0.5) / pixel;
  vec2 drawn = clamp(1.4 - away, 0.0, 1.0) * clamp(1.5 - 3.3 * pixel, 0.0, 1.0);
  return max(drawn.x, drawn.y);
}

void main() {
  vec2 pixel = max(fwidth(vMetres), vec2(1e-9)) / spacing;
  vec2 count = (vMetres + offset) / spacing;
  float amount = max(0.45 * fine * lines(count + 0.5, pixel), 0.8 * lines(0.1 * count + 0.5, 0.1 * pixel));
  float far = vAway / (vAway + 2000.0 * spacing);
  vec3 lit = mix(mix(base, haze, far), line, amount * (1.0 - 0.7 * far));
  if (shade > 0.001) {
    float away = length(vLocal - shadow.xy) / shadow.z;
    lit *= 1.0 - shade * clamp(2.5 - 2.5 * away, 0.0, 1.0);
  }
  gl_FragColor = vec4(lit, 1.0);
}`;
