// The surface that a ray hits, and its material.

struct Hit {
    float distance; // along the ray
    uint primitive; // its id, or noPrimitive
    uint record;    // its index among the sphere or the triangle records
    float u;        // weights of a triangle's first and second vertex
    float v;
    uint instance;  // of a triangle, or noInstance
};

bool isTriangle(uint primitive) {
    if (!hasTriangles || treeSpheres == treeHasSpheresOnly)
        return false;
    if (treeSpheres == treeHasSpheresToo)
        return primitive >= frame.firstTriangleId;
    return sphereCount == 0u || primitive >= minFirstTriangleId;
}

// Texture coordinates of a hit at `position`: 0 on a triangle without any.
SurfaceUv hitUvs(Hit hit, vec3 position) {
    if (isTriangle(hit.primitive)) {
        if ((texturing & texturesCoordinates) == 0u)
            return SurfaceUv(vec2(0.0), vec2(0.0));
        return triangleUvs(hit.record, hit.u, hit.v);
    }
    vec2 uv = sphereUv(position - fetchSphere(hit.record).centre);
    return SurfaceUv(uv, uv);
}

// The material of a hit at `position` with its textures of `textureSlots` and, if the base colour is among them, the
// colour of the vertices applied.
MaterialRecord hitMaterial(Hit hit, MaterialRecord material, uint textureSlots, vec3 position) {
    if ((textureSlots & texturing & texturesMaterials) != 0u && material.textures != 0u)
        material = texturedMaterial(material, textureSlots, hitUvs(hit, position));
    if ((textureSlots & texturesBaseColour) != 0u && (texturing & texturesColours) != 0u && isTriangle(hit.primitive))
        material = colouredMaterial(material, hit.record, hit.u, hit.v);
    return material;
}

// The triangle that is hit, in world space.
TriangleRecord hitTriangle(Hit hit) {
    TriangleRecord triangle = fetchTriangle(hit.record);
    if (hasInstances && hit.instance != noInstance)
        return placedTriangle(fetchInstance(hit.instance), triangle);
    return triangle;
}

NormalRecord hitNormals(Hit hit) {
    NormalRecord normals = fetchNormals(hit.record);
    if (hasInstances && hit.instance != noInstance)
        return placedNormals(fetchInstance(hit.instance), normals);
    return normals;
}

// The surface at the hit of a ray, without its normal map.
Surface smoothSurface(Hit hit, vec3 origin, vec3 direction, out uint materialIndex) {
    if (isTriangle(hit.primitive)) {
        TriangleRecord triangle = hitTriangle(hit);
        materialIndex = triangle.materialIndex;
        if (!hasNormals)
            return flatSurface(triangle, hit.u, hit.v);
        return triangleSurface(triangle, hitNormals(hit), hit.u, hit.v);
    }
    SphereRecord sphere = fetchSphere(hit.record);
    materialIndex = materialIndexOf(sphere);
    return sphereSurface(origin, direction, hit.distance, sphere);
}

// Tangents that come with a triangle's vertices, in world space.
Tangent hitVertexTangent(Hit hit, vec3 normal) {
    uint row = tangentRow(hit.record);
    vec4 t0 = fetchTangent(row);
    vec4 t1 = fetchTangent(row + 1u);
    vec4 t2 = fetchTangent(row + 2u);
    if (hasInstances && hit.instance != noInstance) {
        InstanceRecord instance = fetchInstance(hit.instance);
        t0 = placedTangent(instance, t0);
        t1 = placedTangent(instance, t1);
        t2 = placedTangent(instance, t2);
    }
    return vertexTangent(t0, t1, t2, normal, hit.u, hit.v);
}

// Tangents at the hit, for textures with the second coordinates or the first. `normal` is that of the smooth surface.
Tangent hitTangent(Hit hit, vec3 normal, bool isOfSecondUv) {
    if (isTriangle(hit.primitive)) {
        if ((texturing & texturesTangents) != 0u) {
            Tangent tangent = hitVertexTangent(hit, normal);
            if (isKnown(tangent))
                return tangent;
        }
        if ((texturing & texturesSecondUv) != 0u && isOfSecondUv)
            return triangleTangent(hitTriangle(hit), fetchSecondCoordinates(hit.record));
        return triangleTangent(hitTriangle(hit), fetchCoordinates(hit.record));
    }
    return sphereTangent(normal * normalSignOf(fetchSphere(hit.record)));
}

// The normal that the map in `mapSlot` makes of that of a smooth surface.
vec3 hitNormal(Hit hit, vec3 direction, Surface surface, uint textures, uint mapSlot) {
    if (textures == 0u || !hasTexture(textures, mapSlot))
        return surface.normal;
    uint row = textureRow(textures, mapSlot);
    Tangent tangent = hitTangent(hit, surface.normal, usesSecondUv(row));
    vec3 mapped = mappedNormal(surface.normal, tangent, row, hitUvs(hit, surface.position));
    return visibleNormal(direction, mapped, surface.geometricNormal);
}

// The surface at the hit of a ray.
Surface hitSurface(Hit hit, vec3 origin, vec3 direction, out uint materialIndex) {
    Surface surface = smoothSurface(hit, origin, direction, materialIndex);
    if ((texturing & texturesNormal) != 0u)
        surface.normal = hitNormal(hit, direction, surface, fetchMaterial(materialIndex).textures, slotNormal);
    return surface;
}

// The axes of the material's lobes at the hit. `normal` is on the side of the viewer.
SurfaceAxes hitAxes(Hit hit, vec3 origin, vec3 direction, MaterialRecord material, vec3 normal, bool isBehind) {
    SurfaceAxes axes = SurfaceAxes(vec3(0.0), normal);
    if ((scattering & (scattersAtAnisotropic | scattersAtCoatNormals)) == 0u)
        return axes;
    uint materialIndex;
    Surface surface = smoothSurface(hit, origin, direction, materialIndex);
    if ((scattering & scattersAtAnisotropic) != 0u)
        axes.tangent = hitTangent(hit, surface.normal, false).alongU;
    if ((scattering & scattersAtCoatNormals) != 0u) {
        vec3 coat = surface.normal;
        if ((texturing & texturesClearcoatNormal) != 0u)
            coat = hitNormal(hit, direction, surface, material.textures, slotClearcoatNormal);
        axes.coatNormal = isBehind ? -coat : coat;
    }
    return axes;
}
