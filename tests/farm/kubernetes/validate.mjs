// Checks the documents of a YAML file by the schema of Kubernetes, as strictly as kubectl has it done, and prints them as
// JSON:
//
//   node validate.mjs FILE
//
// kubernetes-models has the schema as functions, which were made from Kubernetes' own OpenAPI document. Keys that the schema
// lacks do not matter to them; but as they read every key that it has, a key that nobody has read is one that it lacks.
import { readFileSync } from "node:fs";
import { parseAllDocuments } from "yaml";

const schemas = {
  "batch/v1 Job": "IoK8sApiBatchV1Job",
  "v1 ConfigMap": "IoK8sApiCoreV1ConfigMap",
  "v1 PersistentVolumeClaim": "IoK8sApiCoreV1PersistentVolumeClaim",
};

/// Of a value with all that is in it: `seen` gets the paths of keys that are read.
function watch(value, path, seen) {
  if (typeof value !== "object" || value === null) return value;
  return new Proxy(value, {
    get(target, key) {
      if (typeof key === "symbol") return target[key];
      seen.add(`${path}/${key}`);
      return watch(target[key], `${path}/${key}`, seen);
    },
  });
}

function* pathsOf(value, path) {
  if (typeof value !== "object" || value === null) return;
  for (const key of Object.keys(value)) {
    yield `${path}/${key}`;
    yield* pathsOf(value[key], `${path}/${key}`);
  }
}

/// What is wrong with an object; empty if nothing is.
async function faultsOf(object) {
  const kind = `${object?.apiVersion} ${object?.kind}`;
  if (!Object.hasOwn(schemas, kind)) return [`${kind}: no schema is known`];
  const { validate } = await import(`./node_modules/kubernetes-models/_schemas/${schemas[kind]}.mjs`);
  const seen = new Set();
  const errors = validate(watch(object, "", seen)) ? [] : validate.errors;
  const wrong = errors.map((error) => `${error.instancePath} breaks ${error.keyword} ${JSON.stringify(error.params)}`);
  const unknown = [...pathsOf(object, "")].filter((path) => !seen.has(path)).map((path) => `${path} is unknown`);
  return [...wrong, ...unknown].map((fault) => `${object.kind} ${object.metadata?.name}: ${fault}`);
}

const faults = [];
const objects = [];
for (const document of parseAllDocuments(readFileSync(process.argv[2], "utf8"))) {
  faults.push(...document.errors.map((error) => error.message));
  objects.push(document.toJS());
  faults.push(...(await faultsOf(objects.at(-1))));
}
for (const fault of faults) console.error(fault);
if (faults.length > 0) process.exit(1);
console.log(JSON.stringify(objects));
