// The traversal by the device's own tree: ray queries over an acceleration structure of boxes, one for each primitive. The
// device finds boxes that a ray may enter; each primitive is tested here, as by all kernels, and the nearest one is kept
// here. So all that counts is that no box is missed.
//
// Vulkan promises neither an order of candidates nor how a box is tested. Boxes are widened by twice what a ray's own
// test of a box allows (queryBoxPad), and the rest covers the device's rounding. The same pad lets ties through: another
// hit at the distance that ends the query is in a box that begins before. A ray that comes from too far away for the pad
// tests all primitives in turn.
//
// A query cannot wait for another dispatch: a ray is traced to its end, whatever the step budget.
#if RAYS != 1
#error "a lane has one query"
#endif

layout(set = 0, binding = bindingNodes) uniform accelerationStructureEXT primitiveBoxes;

void enterTree(uint i) {
    traversal[i].cursorInstance = noInstance;
    traversal[i].cursorNode = 0u;
    traversal[i].cursorTriangle = noNode;
}

void stopTraversal(uint i) {
    traversal[i].cursorNode = noNode;
    traversal[i].cursorTriangle = noNode;
}

// Primitives are in geometries: that of the scene's own, and then one for each instance.
struct Geometry {
    uint instance; // or noInstance
    uint begin;    // of its triangle records
    uint end;
};

Geometry geometryAt(uint index) {
    if (!hasInstances || index == 0u)
        return Geometry(noInstance, 0u, frame.topListLength);
    InstanceRecord instance = fetchInstance(index - 1u);
    return Geometry(index - 1u, instance.listBegin, instance.listEnd);
}

uint geometryCount() { return hasInstances ? 1u + uint(instances.length()) : 1u; }

// Returns whether the ray ends here.
bool testPrimitive(uint i, Geometry geometry, uint record, TriangleRay ray, BoxRay box, const bool isVisibility) {
    TriangleRecord triangle = fetchTriangle(record);
    if (hasInstances && geometry.instance != noInstance)
        triangle = placedTriangle(fetchInstance(geometry.instance), triangle);
    countBusyRay(true);
    countWork(i, true, uvec3(0u, 0u, 1u));
    countPass();
    return meetTriangle(i, record, geometry.instance, triangle, ray, box, isVisibility);
}

void advance(bool takesPart[RAYS], const bool isVisibility) {
    const uint i = 0u;
    if (!takesPart[i] || !isTraversing(i))
        return;
    vec3 origin = traversal[i].ray.origin;
    vec3 direction = traversal[i].ray.direction;
    BoxRay box = makeBoxRay(origin, direction, frame.boundsLower, frame.boundsUpper);
    TriangleRay triangle = makeTriangleRay(origin, direction);
    bool isQuery = 2.0 * box.pad <= queryBoxPad(frame.boundsLower, frame.boundsUpper);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, primitiveBoxes, gl_RayFlagsNoneEXT, 0xFFu, origin, 0.0, direction,
                          traversal[i].hit.distance);
    uint index = 0u;
    Geometry geometry = geometryAt(0u);
    uint record = 0u; // the next one, if all are tested in turn
    bool isRunning = true;
    do {
        bool isTested;
        if (isQuery) {
            isRunning = rayQueryProceedEXT(query);
            isTested = isRunning;
            if (isRunning) {
                geometry = geometryAt(uint(rayQueryGetIntersectionGeometryIndexEXT(query, false)));
                record = geometry.begin + uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
            }
        } else {
            isTested = record < geometry.end;
            if (!isTested) {
                index += 1u;
                isRunning = index < geometryCount();
                if (isRunning) {
                    geometry = geometryAt(index);
                    record = geometry.begin;
                }
            }
        }
        if (isTested) {
            float before = traversal[i].hit.distance;
            if (testPrimitive(i, geometry, record, triangle, box, isVisibility))
                isRunning = false;
            if (isQuery && traversal[i].hit.distance < before)
                rayQueryGenerateIntersectionEXT(query, traversal[i].hit.distance);
            record += 1u;
        }
        stepsTaken += 1u;
    } while (isRunning); // as often as there are primitives at most
    stopTraversal(i);
}
