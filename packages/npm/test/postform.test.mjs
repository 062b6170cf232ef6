// Run after the build: `npm test`. POSTFORM_ROOT is the repository.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { PostformError, load } from "postform";

const root = process.env.POSTFORM_ROOT ?? new URL("../../..", import.meta.url).pathname;
const file = async (name) => ({ name: name.split("/").at(-1), text: await readFile(`${root}/${name}`, "utf8") });
const postform = await load();
const form = await file("postforms/haas.pf");
const job = await file("samples/bracket/job.json");

test("a program is printed and verified", async () => {
  const program = await postform.render(form, job);
  assert.equal(program.program, (await file("samples/bracket/expected.haas.nc")).text);
  assert.match(program.verdict, /^equivalent/);
  assert.match(await postform.verify(form, job, program.program), /^equivalent/);
});

test("a wrong program is different, and a form that prints one is refused", async () => {
  const { program } = await postform.render(form, job);
  assert.match(await postform.verify(form, job, program.replace("G0 Z1.", "G0 Z-1.")), /^different/);
  const wrong = { name: "wrong.pf", text: form.text.replaceAll("G43 H[lcomp]", "H[lcomp]") };
  await assert.rejects(postform.render(wrong, job), (error) => {
    assert.ok(error instanceof PostformError);
    assert.match(error.program, /^%/);
    assert.ok(error.findings.some((finding) => finding.code === "PV014"), JSON.stringify(error.findings));
    return true;
  });
});

test("a program is run", async () => {
  const { actions, warnings, refused } = await postform.simulate("G21 G90 G54\nT1 M6\nG0 X1. Y2.\nG2 X3. Y2. I1. J0. F100.\nM30\n", { control: "haas" });
  const kinds = actions.map(({ line, ...action }) => `${line} ${Object.keys(action)[0]}`);
  // M6 of a Haas also stops the coolant
  assert.deepEqual(kinds.filter((kind) => !kind.includes("spindle")), ["1 units", "1 work", "2 tool", "2 coolant", "3 rapid", "4 arc", "5 stop"]);
  const arc = actions.find((action) => action.arc);
  assert.deepEqual([arc.arc.slice(0, 2), arc.center.slice(0, 2), arc.turn, arc.f], [[3, 2], [2, 2], "cw", 100]);
  assert.deepEqual([warnings, refused], [[], null]);
  const unknown = await postform.simulate("G0 X1.\nM30\n", { control: "haas", startUnknown: true });
  assert.deepEqual(unknown.actions[0].rapid.slice(0, 3), [1, null, null]);
  const wrong = await postform.simulate("G0 X1.\nG777\n", { control: "haas" });
  assert.equal(wrong.actions.length, 1);
  assert.deepEqual([wrong.refused.line, wrong.refused.severity], [2, "error"]);
  await assert.rejects(postform.simulate("", { control: "hass" }), /no control hass; there are .*haas/);
});

test("findings have their positions", async () => {
  const findings = await postform.lint({ name: "a.pf", text: form.text.replace("M30", "Q[nothing]") });
  const finding = findings.find((finding) => finding.code === "PF202");
  assert.equal(finding.file, "a.pf");
  assert.equal(finding.severity, "error");
  assert.ok(finding.line > 100);
});

test("a broken job is an error with its line", async () => {
  await assert.rejects(postform.render(form, { name: "job.json", text: '{"postform": 1,' }), (error) => {
    assert.equal(error.findings.at(-1).code, "PJ007");
    return true;
  });
  for (const options of [{ units: "cm" }, { date: "today" }, { nothing: 1 }]) await assert.rejects(postform.render(form, job, options), PostformError);
});
