in float height;
flat in vec4 top;
flat in vec4 bottom;
layout(location = 0) out vec4 outColor;

void main() {
    // Half a level of noise hides the bands of a slow gradient.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    outColor = vec4(mix(bottom.rgb, top.rgb, height) + noise / 255.0, 1.0);
}
