// Dispersion: glass bends short waves more than long ones. The light of a path is of all waves until it passes a surface
// of such glass; from there on it has one wavelength, and the colour that this stands for.
//
// Colours have three channels, each of which stands for a band of waves: a tent around the dominant wavelength of its
// primary, and for red a smaller one beyond blue, as the eye sees violet. Wavelengths are drawn from the mean of the
// three bands, so that a channel's weight is at most 3; on average light keeps its colour.

// Where the tents stand and how far they reach, in micrometres.
const float redCentre = 0.610;
const float redReach = 0.065;
const float greenCentre = 0.543;
const float greenReach = 0.065;
const float blueCentre = 0.455;
const float blueReach = 0.060;
const float violetCentre = 0.425;
const float violetReach = 0.030;
const float violetShare = 0.08; // of what red stands for
const float shortestWavelength = blueCentre - blueReach;
const float longestWavelength = redCentre + redReach;

// The pdf of a wavelength in a band.
float bandPdf(float wavelength, float centre, float reach) {
    float away = divide(abs(wavelength - centre), reach);
    return divide(greater(1.0 - away, 0.0), reach);
}

// A wavelength of a band, from `u` in [0, 1).
float sampleBand(float centre, float reach, float u) {
    float fromEnd = 2.0 * (u < 0.5 ? u : 1.0 - u);
    float away = reach * (1.0 - squareRoot(fromEnd));
    return u < 0.5 ? centre - away : centre + away;
}

// Light of one wavelength.
struct Wave {
    float bend;  // of the wave number's square to that of yellow light, the d line of helium, in 1 / micrometre^2
    vec3 colour; // of white light of this wavelength; its mean over all is white
};

const float squaredWaveNumberD = 2.8966; // 1 / 0.58756^2

Wave waveOf(float wavelength) {
    float violet = violetShare * bandPdf(wavelength, violetCentre, violetReach);
    float red = (1.0 - violetShare) * bandPdf(wavelength, redCentre, redReach) + violet;
    float green = bandPdf(wavelength, greenCentre, greenReach);
    float blue = bandPdf(wavelength, blueCentre, blueReach);
    float scale = divide(3.0, greater(red + green + blue, 1e-6));
    float squared = wavelength * wavelength;
    return Wave(divide(1.0, squared) - squaredWaveNumberD, vec3(red * scale, green * scale, blue * scale));
}

// The wave of a path, from `u` in [0, 1).
Wave sampleWave(float u) {
    float three = 3.0 * u;
    if (three < violetShare)
        return waveOf(sampleBand(violetCentre, violetReach, divide(three, violetShare)));
    if (three < 1.0)
        return waveOf(sampleBand(redCentre, redReach, choiceBeyond(three, violetShare)));
    return waveOf(three < 2.0 ? sampleBand(greenCentre, greenReach, three - 1.0)
                              : sampleBand(blueCentre, blueReach, three - 2.0));
}

// The refractive index for a wave, by the first two terms of Cauchy's equation, in the range of tables.
float indexFor(MaterialRecord material, float bend) {
    float index = material.refractiveIndex + material.dispersion * bend;
    return greater(lesser(index, 10.0), 1.0);
}
